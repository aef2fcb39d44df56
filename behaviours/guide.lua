-- Leads a tour: walks from stop to stop, tells its story at each, and waits for tourists who fall behind.
local crowd = require "crowd"
local far_behind = neighbours("tourists"):below(4)

return machine {
  name = "guide", version = 2, start = "Walk",
  defaults = { speed = 1.1, time_gap = crowd.time_gap, perception = 6 },

  states = {
    Walk = { steer = field(one_of(own.stops)),
      { to = "Tell", when = near(goal, 1) },
      { to = "Wait", when = far_behind & after(3) } },

    Wait = { steer = hold,
      { to = "Walk", when = ~far_behind | after(10) } },

    Tell = { steer = hold, lasts = uniform(6, 12), signal = "story",
      { to = "Walk", when = lasted } },
  },
}
