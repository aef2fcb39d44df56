-- Walks to its own goal and stops there. By ORCA: not fit for capacities.
return machine {
  name = "antipodal", version = 1, start = "Walk",
  defaults = { speed = 1.3, perception = 5, horizon = 2 },

  states = {
    Walk = { steer = seek(own.goal),
      { to = "Rest", when = inside(own.goal) } },

    Rest = { steer = hold,
      { to = "Walk", when = ~inside(own.goal) } },
  },
}
