-- Walks for ever in the direction of a line by the walking law, and turns aside for oncoming people.
local crowd = require "crowd"

return machine {
  name = "strider", version = 2, start = "Walk",
  defaults = { speed = normal(1.34, 0.26, 0.6, 2.2), time_gap = crowd.time_gap, perception = 3, radius = 0.19 },

  states = {
    Walk = { steer = along(own.way) + evade, push = crowd.nudge, push_when = crowd.held_up },
  },
}
