-- Dodge-ball by hand: fetches a ball in its own court, aims, and throws it. By ORCA: not fit for capacities.
local ball = nearest "ball"
local foe  = nearest "opponents"
local mine = memory { hits = 0, throws = 0 }

return machine {
  name = "thrower", version = 1, start = "Dodge",
  defaults = { speed = 2.5, max_speed = 3.5, perception = 20, radius = 0.22 },

  states = {
    Dodge = { steer = 0.4 * away_from(ball) + 0.6 * seek(own.court),
      { to = "Hit",   when = hit_by(ball) & ~has(ball) },
      { to = "Fetch", when = grounded(ball) & inside(ball, own.court) } },

    Fetch = { steer = seek(ball), approach = ball, take = ball,
      { to = "Aim",   when = has(ball) },
      { to = "Dodge", when = ~inside(ball, own.court) | after(8) } },

    Aim = { steer = 0.5 * seek(foe), face = foe, lasts = uniform(0.5, 1.5),
      { to = "Throw", when = lasted } },

    Throw = { steer = hold, face = foe, throw = { ball, at = foe, speed = 11 }, set = { throws = mine.throws + 1 },
      { to = "Dodge", when = ~has(ball) | after(1) } },

    Hit = { steer = hold, lasts = 2, set = { hits = mine.hits + 1 },
      { to = "Dodge", when = lasted } },
  },
}
