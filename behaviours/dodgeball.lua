-- Dodge-ball: run from a ball that flies; kick one that lies in one's own court. By ORCA: not fit for capacities.
-- A ball that hits who defends is a point for the other side: who was hit stands for a second, and counts it in `hits`.
local ball = nearest "ball"
local mine_to_kick = grounded(ball) & inside(ball, own.court)
local mine = memory { hits = 0 }

return machine {
  name = "dodgeball", version = 2, start = "Defense",
  defaults = { speed = 2.5, max_speed = 4, perception = 30, horizon = 2, mass = 70 },

  states = {
    -- What one has kicked oneself may still touch for a moment.
    Defense = { steer = away_from(ball),
      { to = "Hit",     when = hit_by(ball) & after(0.3) },
      { to = "Attack",  when = mine_to_kick } },

    -- Approached, the ball is not avoided, and others in the way are run into; the kick grows with the
    -- runner's speed.
    Attack = { steer = seek(ball), approach = ball, ignore = "ball", speed = 3,
      kick = { ball, at = nearest "opponents", impulse = 2 + 2 * now.speed },
      { to = "Defense", when = kicked(ball) | grounded(ball) & ~inside(ball, own.court) } },

    Hit = { steer = hold, lasts = 1, set = { hits = mine.hits + 1 },
      { to = "Defense", when = lasted } },
  },
}
