-- A person drives this agent; touching the ball kicks it at an opponent. If nobody drives it for 8 s, it plays by
-- itself until it is driven again. By ORCA: not fit for capacities.
local ball = nearest "ball"
local mine_to_kick = grounded(ball) & inside(ball, own.court)
local driven = now.driven:above(0)
local kick = { ball, at = nearest "opponents", impulse = 2 + 2 * now.speed }

return machine {
  name = "dodgeball_player", version = 1, start = "Play",
  defaults = { speed = 3, max_speed = 4, perception = 20, mass = 70 },

  states = {
    Play = { steer = player, approach = ball, kick = kick,
      { to = "Defend", when = stuck(8) & ~driven } },

    Defend = { steer = away_from(ball), speed = 2.5,
      { to = "Play",   when = driven },
      { to = "Attack", when = mine_to_kick } },

    Attack = { steer = seek(ball), approach = ball, ignore = "ball", kick = kick,
      { to = "Play",   when = driven },
      { to = "Defend", when = kicked(ball) | grounded(ball) & ~inside(ball, own.court) } },
  },
}
