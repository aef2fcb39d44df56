-- Walks to a goal with its party: an agent that is apart from the party waits, or walks to it first.
local crowd = require "crowd"
local mate = nearest "teammates"
local apart = distance(mate):above(2.5) & sees(mate)

return machine {
  name = "companion", version = 2, start = "Walk",
  defaults = { speed = normal(1.2, 0.2, 0.8, 1.7), time_gap = crowd.time_gap, perception = 10 },

  states = {
    Walk = { steer = seek(own.goal) + 0.6 * together(0.8),
      { to = "Gone", when = inside(own.goal) },
      { to = "Wait", when = apart & ~near(own.goal, 5), chance = 0.5 } },

    Wait = { steer = together(0.8), speed = 0.8 * own.speed,
      { to = "Walk", when = ~apart | after(6) } },

    Gone = { removes = true },
  },
}
