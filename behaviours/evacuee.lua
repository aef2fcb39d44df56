-- Hears the alarm, hesitates, passes it on, and leaves by the exit that it reaches first.
local crowd = require "crowd"

return machine {
  name = "evacuee", version = 2, start = "Work",
  defaults = { speed = normal(1.3, 0.2, 0.7, 2), time_gap = crowd.time_gap, perception = 6, radius = 0.19 },

  states = {
    Work = { steer = hold,
      { to = "Hesitate", when = after(own.alarm) },
      { to = "Hesitate", when = heard("alarm", 5) } },

    -- The time before people move is long and differs much; it matters more than their speed.
    Hesitate = { steer = hold, lasts = normal(6, 3, 1, 15),
      { to = "Leave",    when = lasted } },

    Leave = { steer = field(own.exits), signal = { "alarm", every = 1 },
      push = crowd.nudge, push_when = crowd.held_up,
      { to = "Out",      when = inside(own.exits) } },

    Out = { removes = true },
  },
}
