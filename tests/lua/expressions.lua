local wanted = min(3, 1 + own.horizon * 2) / 2 + abs(-1) - clamp(5, 0, 1)
  + either(after(9), 1, 0) - either(~after(9), 0.25, 1) + either(after(0), 0.25, 7)
return machine { name = "expressions", version = 1, start = "Run",
  defaults = { horizon = choose(0.5), max_speed = 4 }, states = {
  Run = { steer = seek "post" + 0 * spread, speed = 1 + wanted,
    { to = "Pass", when = now.speed:above(1.9) & now.speed:below(2.1) },
    { to = "Fail", when = after(2) } },
  Pass = { steer = hold }, Fail = {} } }
