-- Walks through a door, each at a point of their own across it, then on to a goal, and leaves there.
local crowd = require "crowd"

return machine {
  name = "leaver", version = 1, start = "ToDoor",
  defaults = { speed = normal(1.34, 0.26, 0.6, 2.2), perception = 3, radius = 0.19 },

  states = {
    ToDoor = { steer = seek(own.door), speed = crowd.by_headway, horizon = crowd.foresight,
      push = crowd.nudge, push_when = crowd.held_up,
      { to = "AtDoor", when = near(own.door, 2.5) } },

    AtDoor = { steer = seek(own.door), speed = crowd.at_door, horizon = 0.3,
      push = crowd.nudge, push_when = crowd.slow_at_door,
      { to = "Walk", when = crosses(own.door) | near(own.door, 0.1) },
      { to = "ToDoor", when = ~near(own.door, 3) } },

    Walk = { steer = seek(own.goal), speed = crowd.by_headway, horizon = crowd.foresight,
      push = crowd.nudge, push_when = crowd.held_up,
      { to = "Gone", when = inside(own.goal) } },

    Gone = { removes = true },
  },
}
