-- Runs into a runner and holds on to them until they are down. By ORCA: not fit for capacities.
local runner = nearest("runners"):in_state("Run")
local prey   = nearest "runners"

return machine {
  name = "tackler", version = 1, start = "Wait",
  defaults = { speed = normal(5, 0.4), max_speed = 6.5, perception = 14, horizon = 0.6, mass = normal(95, 10) },

  states = {
    Wait = { steer = hold, face = runner,
      { to = "Chase", when = near(runner, 7) } },

    Chase = { steer = seek(runner), approach = runner, grasp = runner, grip = 1500,
      { to = "Hold", when = has(prey) },
      { to = "Wait", when = ~sees(runner) } },

    Hold = { steer = hold, approach = prey, grasp = prey, grip = 1500, absorb = 1,
      { to = "Rise", when = ~has(prey) | after(4) } },

    Rise = { steer = hold, { to = "Wait", when = after(1.5) } },
  },
}
