-- Walks to a goal by the walking law, by the way that takes least time, and leaves there.
local crowd = require "crowd"

return machine {
  name = "walker", version = 3, start = "Walk",
  defaults = { speed = normal(1.34, 0.26, 0.6, 2.2), time_gap = crowd.time_gap, perception = 3, radius = 0.19 },

  states = {
    Walk = { steer = field(own.goal), push = crowd.nudge, push_when = crowd.held_up,
      { to = "Gone", when = inside(own.goal) } },

    Gone = { removes = true },
  },
}
