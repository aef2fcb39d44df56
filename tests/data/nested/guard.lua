-- Patrols, looks after whom it sees, and goes on where it was.
local patrol = require "patrol"
local mine = memory { rounds = 0, greeted = 0 }

return machine {
  name = "guard", version = 1, start = "Guard",
  defaults = { horizon = 0.5 },

  states = {
    Guard = { runs = patrol, lasts = uniform(0.2, 0.5), push = 20, on_enter = function(me) me.greeted = me.greeted + 1 end,
      { to = "Rest",  when = done },
      { to = "Greet", when = lasted, chance = 0.7 } },

    Greet = { steer = hold, { to = back, when = after(0.1) } },

    Rest = { steer = hold, set = { rounds = 0 }, { to = "Guard", when = after(0.2) } },
  },
}
