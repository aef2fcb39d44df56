-- Walks from place to place, drawn at random, round walls, and stays a while at each.
local crowd = require "crowd"

return machine {
  name = "wanderer", version = 2, start = "Choose",
  defaults = { speed = normal(1, 0.2, 0.5, 1.6), time_gap = crowd.time_gap, perception = 4 },

  states = {
    Choose = { steer = hold,
      { to = "Walk" } },

    Walk = { steer = field(one_of(own.places)),
      { to = "Stay",  when = near(goal, 1) | arrived(goal) | after(90) } },

    Stay = { steer = hold, face = goal, lasts = uniform(3, 15),
      { to = "Walk",  when = lasted } },
  },
}
