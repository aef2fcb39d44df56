-- Walks through a door, each at a point of their own across it, then on to a goal, and leaves there.
local crowd = require "crowd"

return machine {
  name = "leaver", version = 1, start = "ToDoor",
  defaults = { speed = normal(1.34, 0.26, 0.6, 2.2), perception = 3 },

  states = {
    ToDoor = { steer = seek(own.door), speed = crowd.by_headway, push = crowd.nudge, push_when = crowd.held_up,
      { to = "Walk", when = crosses(own.door) } },

    Walk = { steer = seek(own.goal), speed = crowd.by_headway, push = crowd.nudge, push_when = crowd.held_up,
      { to = "Gone", when = inside(own.goal) } },

    Gone = { removes = true },
  },
}
