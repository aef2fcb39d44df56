-- Dodge-ball by hand: fetches a ball in its own court, picks an opponent, and throws it. Who is hit tells the thrower,
-- who counts a point. A person may drive it: it is theirs from then on, takes a ball that it comes to, and throws it
-- when the button is pressed. Nobody leaves their court (own.court). By ORCA: not fit for capacities.
local ball, flying = nearest "ball", nearest("ball"):flying()
local ahead = nearest("opponents"):ahead(45)
local mine = memory { hits = 0, throws = 0, points = 0, foe = nobody }
local scores = { when = told "hit", set = { points = mine.points + 1 } }
local driven, held = now.played:above(0), now.button:above(0)

return machine {
  name = "thrower", version = 3, start = "Dodge",
  defaults = { speed = 2.5, max_speed = 3.5, perception = 20, radius = 0.22 },
  -- Time to aim, s; speed of a throw, m/s; share of flying balls that are dodged.
  own = { aim = uniform(0.5, 1.5), hard = 11, attention = 0 },

  states = {
    Dodge = { steer = 0.4 * away_from(ball) + 0.6 * seek(own.court), stays_in = own.court, scores,
      { to = "Play",  when = driven },
      { to = "Hit",   when = hit_by(ball) },
      { to = "Aside", when = sees(flying:incoming(0.6)), chance = own.attention },
      { to = "Fetch", when = grounded(ball) & inside(ball, own.court) } },

    Aside = { steer = dodge(flying, 0.8), speed = 3.5, stays_in = own.court, scores,
      { to = "Hit",   when = hit_by(ball) },
      { to = "Dodge", when = ~sees(flying) | after(0.8) } },

    Fetch = { steer = seek(ball), approach = ball, take = ball, stays_in = own.court, scores,
      { to = "Play",  when = driven },
      { to = "Aim",   when = exists(holding) },
      { to = "Dodge", when = ~inside(ball, own.court) | after(8) } },

    Aim = { steer = 0.5 * seek(mine.foe), face = mine.foe, stays_in = own.court, lasts = own.aim, scores,
      set = { foe = nearest "opponents" },
      { to = "Play",  when = driven },
      { to = "Throw", when = lasted } },

    Throw = { steer = hold, face = mine.foe, throw = { holding, at = mine.foe, speed = own.hard }, scores,
      set = { throws = mine.throws + 1 },
      { to = "Dodge", when = ~exists(holding) | after(1) } },

    Hit = { steer = hold, lasts = 2, set = { hits = mine.hits + 1 }, tell = { striker, "hit" }, scores,
      { to = "Play",  when = lasted & driven },
      { to = "Dodge", when = lasted } },

    -- A person plays. The throw goes to the nearest opponent ahead, or, if none is ahead, to the nearest.
    Play = { steer = player, speed = 3.3, damping = 12, approach = ball, take = ball, stays_in = own.court, scores,
      { to = "Hit",   when = hit_by(flying) & ~has(ball) },
      { to = "Throw", when = held & exists(holding) & exists(ahead), set = { foe = ahead } },
      { to = "Throw", when = held & exists(holding), set = { foe = nearest "opponents" } } },
  },
}
