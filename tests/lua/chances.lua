return machine { name = "chances", version = 1, start = "A", states = {
  A = { { to = "Fail", when = after(0.2), chance = 0 },
        { to = "Pass", when = after(0.5), chance = 1 } },
  Pass = {}, Fail = {} } }
