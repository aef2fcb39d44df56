-- Walks through an entrance, then an exit, each at a point of their own across it, on to a goal, and leaves there.
local crowd = require "crowd"

return machine {
  name = "passer", version = 1, start = "ToEntrance",
  defaults = { speed = normal(1.34, 0.26, 0.6, 2.2), perception = 3 },

  states = {
    ToEntrance = { steer = seek(own.entrance), speed = crowd.by_headway, push = crowd.nudge, push_when = crowd.held_up,
      { to = "ToExit", when = crosses(own.entrance) } },

    ToExit = { steer = seek(own.exit), speed = crowd.by_headway, push = crowd.nudge, push_when = crowd.held_up,
      { to = "Walk", when = crosses(own.exit) } },

    Walk = { steer = seek(own.goal), speed = crowd.by_headway, push = crowd.nudge, push_when = crowd.held_up,
      { to = "Gone", when = inside(own.goal) } },

    Gone = { removes = true },
  },
}
