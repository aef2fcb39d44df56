-- Dodge-ball: runs from a flying ball, kicks one that lies in its own court. By ORCA: not fit for capacities.
-- A ball that hits a defender is a point for the other side: the defender stands for a second, and counts it in `hits`.
local ball = nearest "ball"
local mine_to_kick = grounded(ball) & inside(ball, own.court)
local mine = memory { hits = 0 }

return machine {
  name = "dodgeball", version = 2, start = "Defense",
  defaults = { speed = 2.5, max_speed = 4, perception = 30, horizon = 2, mass = 70 },

  states = {
    -- The ball that an agent has just kicked may still touch it for a moment.
    Defense = { steer = away_from(ball),
      { to = "Hit",     when = hit_by(ball) & after(0.3) },
      { to = "Attack",  when = mine_to_kick } },

    -- While the ball is approached it is not avoided, nor are agents in the way; faster runners kick
    -- harder.
    Attack = { steer = seek(ball), approach = ball, ignore = "ball", speed = 3,
      kick = { ball, at = nearest "opponents", impulse = 2 + 2 * now.speed },
      { to = "Defense", when = kicked(ball) | grounded(ball) & ~inside(ball, own.court) } },

    Hit = { steer = hold, lasts = 1, set = { hits = mine.hits + 1 },
      { to = "Defense", when = lasted } },
  },
}
