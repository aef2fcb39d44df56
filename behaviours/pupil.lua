-- Sits in class until somebody says to go out, walks to the assembly point, and reports to whom said so.
local mine = memory { told_by = nobody }
local out = told "out"

return machine {
  name = "pupil", version = 1, start = "Sit",
  own = { assembly = "yard" },
  defaults = { speed = normal(1.1, 0.15, 0.7, 1.5), radius = 0.18, mass = normal(40, 6, 25, 60), perception = 12 },

  states = {
    Sit = { steer = hold,
      { to = "Walk",  when = out & after(1), set = { told_by = out.sender } } },

    Walk = { steer = field(own.assembly), colour = "sky",
      { to = "Stand", when = arrived(own.assembly), tell = { mine.told_by, "here" } } },

    Stand = { steer = gather(own.assembly), colour = "green", { when = out } },
  },
}
