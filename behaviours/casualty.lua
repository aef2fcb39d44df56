-- Lies until two agents hold it, and is then carried: without friction of feet it moves where it is pulled.
-- By ORCA: not fit for capacities.
memory { safe = false }

return machine {
  name = "casualty", version = 1, start = "Lie",
  defaults = { mass = normal(75, 8) },

  states = {
    Lie = { steer = hold, lies = true,
      { to = "Carried", when = holders:at_least(2) } },

    Carried = { steer = hold, lies = true, damping = 0,
      { to = "Safe", when = inside(own.refuge) },
      { to = "Lie",  when = holders:below(2) } },

    Safe = { steer = hold, lies = true, set = { safe = true } },
  },
}
