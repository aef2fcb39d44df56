-- Walks on for ever the way a line points, as fast as the free way ahead allows, out of the way of who comes towards.
local crowd = require "crowd"

return machine {
  name = "strider", version = 1, start = "Walk",
  defaults = { speed = normal(1.34, 0.26, 0.6, 2.2), perception = 3, radius = 0.19 },

  states = {
    Walk = { steer = along(own.way) + 1.3 * evade, speed = crowd.by_headway, horizon = crowd.foresight,
      push = crowd.nudge, push_when = crowd.held_up },
  },
}
