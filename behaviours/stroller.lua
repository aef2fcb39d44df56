-- Strolls about with a purse. Who is robbed notices it after a moment, and tells the constables near by who did it.
local mine = memory { purse = 10, thief = nobody }
local robbed = told "robbed"

return machine {
  name = "stroller", version = 1, start = "Stroll", public = "purse",
  own = { range = "square" },
  defaults = { speed = normal(0.9, 0.2, 0.5, 1.4), perception = 15 },

  states = {
    Stroll = { steer = wander(own.range),
      { to = "Feel", when = robbed, set = { purse = 0, thief = robbed.sender } } },

    Feel = { steer = hold, lasts = uniform(0.5, 2),
      { to = "Call", when = lasted } },

    Call = { steer = hold, face = mine.thief, colour = "vermilion",
      { every = 1, tell = { neighbours("constables"):within(12), "thief", who = mine.thief } },
      { to = "Stroll", when = after(5) | ~exists(mine.thief) } },
  },
}
