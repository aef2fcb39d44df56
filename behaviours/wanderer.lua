-- Goes from place to place as it likes, stays a while at each, round whatever walls there are.
return machine {
  name = "wanderer", version = 1, start = "Choose",
  defaults = { speed = normal(1, 0.2, 0.5, 1.6), perception = 4 },

  states = {
    Choose = { steer = hold,
      { to = "Walk" } },

    Walk = { steer = field(one_of(own.places)),
      { to = "Stay",  when = near(goal, 1) | after(90) } },

    Stay = { steer = hold, face = goal, lasts = uniform(3, 15),
      { to = "Walk",  when = lasted } },
  },
}
