-- Walks through an entrance, then an exit, each at a point of their own across it, on to a goal, and leaves there.
local crowd = require "crowd"

return machine {
  name = "passer", version = 1, start = "ToEntrance",
  defaults = { speed = normal(1.34, 0.26, 0.6, 2.2), perception = 3, radius = 0.19 },

  states = {
    ToEntrance = { steer = seek(own.entrance), speed = crowd.by_headway, horizon = crowd.foresight,
      push = crowd.nudge, push_when = crowd.held_up,
      { to = "AtEntrance", when = near(own.entrance, 2.5) } },

    AtEntrance = { steer = seek(own.entrance), speed = crowd.at_door, horizon = 0.3,
      push = crowd.nudge, push_when = crowd.slow_at_door,
      { to = "ToExit", when = crosses(own.entrance) | near(own.entrance, 0.1) },
      { to = "ToEntrance", when = ~near(own.entrance, 3) } },

    ToExit = { steer = seek(own.exit), speed = crowd.by_headway, horizon = crowd.foresight,
      push = crowd.nudge, push_when = crowd.held_up,
      { to = "AtExit", when = near(own.exit, 2.5) } },

    AtExit = { steer = seek(own.exit), speed = crowd.at_door, horizon = 0.3,
      push = crowd.nudge, push_when = crowd.slow_at_door,
      { to = "Walk", when = crosses(own.exit) | near(own.exit, 0.1) },
      { to = "ToExit", when = ~near(own.exit, 3) } },

    Walk = { steer = seek(own.goal), speed = crowd.by_headway, horizon = crowd.foresight,
      push = crowd.nudge, push_when = crowd.held_up,
      { to = "Gone", when = inside(own.goal) } },

    Gone = { removes = true },
  },
}
