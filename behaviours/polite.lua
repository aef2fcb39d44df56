-- Polite: looks far ahead, never pushes, takes most of the avoidance itself. By ORCA: not fit for capacities.
return machine {
  name = "polite", version = 1, start = "Walk",
  defaults = { speed = 1.6, max_speed = 2, perception = 5, horizon = 2, yield = 0.9 },

  states = {
    Walk = { steer = seek(own.goal),
      { to = "Arrived", when = inside(own.goal) } },

    Arrived = { steer = hold },
  },
}
