-- Waits on the platform until the doors open, boards, and then becomes a stander.
local crowd = require "crowd"

return machine {
  name = "commuter", version = 2, start = "Wait",
  defaults = { speed = normal(1.3, 0.2, 0.8, 1.8), time_gap = crowd.time_gap, perception = 3, push = crowd.nudge },

  states = {
    Wait = { steer = hold, face = own.door,
      { to = "Board", when = after(own.opens) } },

    Board = { steer = field(own.car), push_when = crowd.held_up,
      { to = "Ride",  when = inside(own.car) & (density_here:above(3) | after(12)) } },

    Ride = { become = "stander" },
  },
}
