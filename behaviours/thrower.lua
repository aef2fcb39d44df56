-- Dodge-ball by hand: fetches a ball in its own court, picks an opponent, and throws it. Who is hit tells the thrower,
-- who counts a point. By ORCA: not fit for capacities.
local ball = nearest "ball"
local mine = memory { hits = 0, throws = 0, points = 0, foe = nobody }
local scores = { when = told "hit", set = { points = mine.points + 1 } }

return machine {
  name = "thrower", version = 2, start = "Dodge",
  defaults = { speed = 2.5, max_speed = 3.5, perception = 20, radius = 0.22 },

  states = {
    Dodge = { steer = 0.4 * away_from(ball) + 0.6 * seek(own.court), scores,
      { to = "Hit",   when = hit_by(ball) },
      { to = "Fetch", when = grounded(ball) & inside(ball, own.court) } },

    Fetch = { steer = seek(ball), approach = ball, take = ball, scores,
      { to = "Aim",   when = exists(holding) },
      { to = "Dodge", when = ~inside(ball, own.court) | after(8) } },

    Aim = { steer = 0.5 * seek(mine.foe), face = mine.foe, lasts = uniform(0.5, 1.5), scores,
      set = { foe = nearest "opponents" },
      { to = "Throw", when = lasted } },

    Throw = { steer = hold, face = mine.foe, throw = { holding, at = mine.foe, speed = 11 }, scores,
      set = { throws = mine.throws + 1 },
      { to = "Dodge", when = ~exists(holding) | after(1) } },

    Hit = { steer = hold, lasts = 2, set = { hits = mine.hits + 1 }, tell = { striker, "hit" }, scores,
      { to = "Dodge", when = lasted } },
  },
}
