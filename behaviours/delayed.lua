-- Waits for its pre-movement time, from the alarm to the first step, then walks to a goal and leaves there.
local crowd = require "crowd"

return machine {
  name = "delayed", version = 1, start = "Wait",
  defaults = { speed = normal(1.34, 0.26, 0.6, 2.2), time_gap = crowd.time_gap, perception = 3, radius = 0.19 },

  states = {
    Wait = { steer = hold,
      { to = "Walk", when = after(own.premovement) } },

    Walk = { steer = field(own.goal), push = crowd.nudge, push_when = crowd.held_up,
      { to = "Gone", when = inside(own.goal) } },

    Gone = { removes = true },
  },
}
