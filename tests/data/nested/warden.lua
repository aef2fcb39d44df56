-- Errands by day, a patrol by night, two levels deep.
local patrol = require "patrol"

return machine {
  name = "warden", version = 1, start = "Day",

  states = {
    Day = { { to = "Night", when = after(0.7) },
      runs = sequence { seek "east", wait(0.1), "Turn", { steer = seek "west", lasts = uniform(0.1, 0.2) },
        sequence { wait(0.05), wait(uniform(0.05, 0.1)) } } },

    Night = { { to = "Day", when = done },
      runs = machine { start = "Round", states = {
        Round = { runs = patrol, speed = 0.9, { to = "Sit", when = done }, { to = "Call", when = after(0.3) } },
        Call  = { signal = { "night", every = 0.1 }, { to = back, when = after(0.05) } },
        Sit   = { ends = true } } } },
  },
}
