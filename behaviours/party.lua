-- Walks to a goal with its party: a member that is ahead of the others stands until they have come up, so that all
-- arrive together, at the pace of the slowest.
local crowd = require "crowd"

return machine {
  name = "party", version = 1, start = "Walk",
  defaults = { speed = normal(1.34, 0.26, 0.6, 2.2), time_gap = crowd.time_gap, perception = 10, neighbours = 16,
    radius = 0.19 },

  states = {
    Walk = { steer = field(own.goal) + 2 * together(0.4), push = crowd.nudge, push_when = crowd.held_up,
      { to = "Gone", when = inside(own.goal) } },

    Gone = { removes = true },
  },
}
