return machine {
  name = "presser2", version = 1, start = "Walk",
  defaults = { speed = normal(1.3, 0.15, 0.8, 1.8), perception = 3, horizon = 0.5 },

  states = {
    Walk = { steer = field(own.goal), push = 80 * max(now.speed, own.speed), lasts = uniform(0.3, 1),
      { to = "Gone", when = inside(own.goal) },
      { to = "Rest", when = lasted } },
    Rest = { steer = field(own.goal), push = 0, lasts = uniform(0.3, 1),
      { to = "Gone", when = inside(own.goal) },
      { to = "Walk", when = lasted } },

    Gone = { removes = true },
  },
}
