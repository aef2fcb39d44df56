-- Dodge-ball: keeps away from the ball, dodges it when it comes flying, kicks one that lies in its own court. By ORCA:
-- not fit for capacities. A ball that hits a defender is a point for the other side: the defender stands for a second,
-- and counts it in `hits`. A person may drive it: it is theirs from then on, walks at 3.2 m/s, and runs for 1.2 s while
-- the button is held. Nobody leaves their court (own.court).
local ball, foe = nearest "ball", nearest "opponents"
local mine = memory { hits = 0, dodges = 0, struck = -10 } -- struck: time of the last kick of a person, s
local driven, held = now.played:above(0), now.button:above(0)
local flying = nearest("ball"):flying() -- of many balls, the one to dodge is seldom the nearest
local flies_at_me = sees(flying:incoming(0.6))
local REBOUND = 0.8 -- s after a kick, in which the ball may come back from a wall

-- The faster the run-up, the harder the kick. It is raised so far that the ball comes to the opponent at CHEST, if it
-- is hard enough: the slope s of a kick of speed v that reaches height h at distance d is the smaller root of
-- h = d s - fall (1 + s^2), where fall = g d^2 / (2 v^2). The lift is its arc tangent, in degrees, by an approximation
-- within 1 %.
local CHEST, HIGHEST = 0.8, 35 -- m; degrees: higher balls are dodged easily
local hard, far = 5 + own.run_up * now.speed, clamp(distance(foe), 1, 30)
local fall = 4.9 * far * far / (hard * hard)
local slope = (far - sqrt(far * far - 4 * fall * (fall + CHEST))) / (2 * fall)
local lift = clamp(57.3 * slope / (1 + 0.28 * slope * slope), 0, HIGHEST)
local kick = { ball, at = foe, speed = hard, lift = lift }

return machine {
  name = "dodgeball", version = 6, start = "Defense",
  defaults = { speed = 2.5, max_speed = 4, perception = 30, horizon = 2, mass = 70 },
  -- Share of flying balls that are noticed; time until the player moves, s; speed of a kick per speed of the run-up.
  own = { attention = 0.85, reaction = 0.3, run_up = 2 },

  states = {
    -- A ball that the player has not noticed is not avoided.
    Defense = { steer = 0.6 * seek(home) + 0.4 * away_from(ball), face = ball, ignore = "ball", stays_in = own.court,
      { to = "Play",   when = driven },
      { to = "Hit",    when = hit_by(ball) & after(REBOUND) },
      { to = "Attack", when = grounded(ball) & inside(ball, own.court) },
      { to = "Notice", when = flies_at_me & after(REBOUND), chance = own.attention } },

    Notice = { steer = 0.6 * seek(home), face = ball, ignore = "ball", lasts = own.reaction,
      stays_in = own.court,
      { to = "Play",    when = driven },
      { to = "Hit",     when = hit_by(ball) },
      { to = "Dodge",   when = lasted } },

    Dodge = { steer = dodge(flying:incoming(0.8), 0.8), face = flying, speed = 4, stays_in = own.court,
      { to = "Play",    when = driven },
      { to = "Hit",     when = hit_by(ball) },
      { to = "Defense", when = ~sees(flying) | after(1), set = { dodges = mine.dodges + 1 } } },

    -- While the ball is approached it is not avoided, nor are agents in the way. Another one that flies at the player
    -- is dodged.
    Attack = { steer = seek(ball), approach = ball, ignore = "ball", speed = 3.5, kick = kick, stays_in = own.court,
      { to = "Play",    when = driven },
      { to = "Notice",  when = flies_at_me & grounded(ball), chance = own.attention },
      { to = "Defense", when = kicked(ball) | ~inside(ball, own.court) } },

    Hit = { steer = hold, lasts = 1, set = { hits = mine.hits + 1 },
      { to = "Play",    when = lasted & driven },
      { to = "Defense", when = lasted } },

    -- A person plays. A ball in the air hits; one on the ground is kicked.
    Play = { steer = player, approach = ball, ignore = "ball", stays_in = own.court, max_speed = 5, damping = 12,
      runs = machine { start = "Walk", states = {
        Walk = { speed = 3.2,               { to = "Run",  when = held } },
        Run =  { speed = 4.6, lasts = 1.2,  { to = "Rest", when = lasted | ~held } },
        Rest = { speed = 2.8, lasts = 1.5,  { to = "Walk", when = lasted } } } },
      { to = "Hit",    when = hit_by(ball) & ~grounded(ball) & (now.time - mine.struck):above(REBOUND) },
      { to = "Strike", when = grounded(ball) & near(ball, 0.8) } },

    Strike = { steer = player, approach = ball, ignore = "ball", stays_in = own.court, kick = kick,
      speed = 4, max_speed = 5, damping = 12,
      { to = "Play",   when = kicked(ball), set = { struck = now.time } },
      { to = "Play",   when = ~near(ball, 0.9) } },
  },
}
