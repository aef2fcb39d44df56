-- Walks to a goal and back home, for ever.
local crowd = require "crowd"

return machine {
  name = "pedestrian", version = 2, start = "There",
  defaults = { speed = normal(1.34, 0.26, 0.6, 2.2), time_gap = crowd.time_gap, perception = 4 },

  states = {
    There = { steer = seek(own.goal),
      { to = "Back",  when = inside(own.goal) } },

    Back = { steer = seek(own.home),
      { to = "There", when = inside(own.home) } },
  },
}
