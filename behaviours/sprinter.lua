-- Runs for the end zone past tacklers; tears itself away from agents that hold it, or goes down. By ORCA: not
-- fit for capacities.
memory { home = false, down = false }

return machine {
  name = "sprinter", version = 1, start = "Run",
  defaults = { speed = normal(5.5, 0.4), max_speed = 7, perception = 8, horizon = 0.8, mass = normal(85, 8) },

  states = {
    Run = { steer = seek(own.zone) + evade,
      { to = "Home", when = inside(own.zone) },
      { to = "Held", when = holders:above(0) } },

    Held = { steer = seek(own.zone),
      { to = "Home", when = inside(own.zone) },
      { to = "Down", when = after(1.5) },
      { to = "Run",  when = holders:at_most(0) } },

    Home = { steer = hold, set = { home = true } },
    Down = { steer = hold, lies = true, set = { down = true } },
  },
}
