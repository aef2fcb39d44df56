-- Presses towards a goal round the walls. By ORCA: not fit for capacities.
-- Pushes agents ahead while it is slower than it wants to be.
return machine {
  name = "presser", version = 1, start = "Walk",
  defaults = { speed = normal(1.3, 0.15, 0.8, 1.8), perception = 3, horizon = 0.5, push = 50 },

  states = {
    Walk = { steer = field(own.goal), push = own.push * max(now.speed, own.speed),
      { to = "Gone", when = inside(own.goal) } },

    Gone = { removes = true },
  },
}
