-- Walks to a goal and back home, for ever, more slowly where it is denser.
local crowd = require "crowd"

return machine {
  name = "pedestrian", version = 1, start = "There",
  defaults = { speed = normal(1.34, 0.26, 0.6, 2.2), perception = 4, horizon = 1 },

  states = {
    There = { steer = seek(own.goal), speed = crowd.weidmann,
      { to = "Back",  when = inside(own.goal) } },

    Back = { steer = seek(own.home), speed = crowd.weidmann,
      { to = "There", when = inside(own.home) } },
  },
}
