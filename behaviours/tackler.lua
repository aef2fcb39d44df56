-- Picks a runner, runs into them and holds on until they are down. By ORCA: not fit for capacities.
local mine = memory { prey = nobody }
local runner = nearest("runners"):in_state("Run")

return machine {
  name = "tackler", version = 2, start = "Wait",
  defaults = { speed = normal(5, 0.4), max_speed = 6.5, perception = 14, horizon = 0.6, mass = normal(95, 10) },
  own = { grip = 1500, rest = 1.5 }, -- force of the hold, N; time to get up, s

  states = {
    Wait = { steer = hold, face = runner,
      { to = "Chase", when = near(runner, 7), set = { prey = runner } } },

    Chase = { steer = seek(mine.prey), approach = mine.prey, grasp = mine.prey, grip = own.grip,
      { to = "Hold", when = exists(holding) },
      { to = "Wait", when = ~sees(mine.prey:in_state("Run")) } },

    Hold = { steer = hold, approach = holding, grasp = holding, grip = own.grip, absorb = 1,
      { to = "Rise", when = ~exists(holding) | after(4) } },

    Rise = { steer = hold, { to = "Wait", when = after(own.rest) } },
  },
}
