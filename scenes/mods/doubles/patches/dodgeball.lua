-- Patch of the machine: with more players, the one nearest to the ball takes it; the others keep away. Kicks are flat.
local ball = nearest "ball"

return patch "dodgeball" {
  defaults = { perception = 12 },
  states = {
    Defense = { steer = away_from(ball) + 0.4 * seek(own.court) + 0.3 * spread,
      change = { Attack = { when = grounded(ball) & inside(ball, own.court) & near(ball, 6) } } },
    Attack = { kick = { lift = 15 }, append = { { to = "Defense", when = after(6), id = "give_up" } } },
  },
}
