-- The Tawaf: seven circuits of the Kaaba, counter-clockwise, counted from the start line.
local mine     = memory { laps = 0, touched = false }   -- per agent; survives reloads
local at_line  = crosses "start_line"
local crowded  = density("black_stone"):above(6)        -- people per square metre
local shove    = 30 * max(now.speed, own.speed)         -- newtons; present speed alone cannot break a standstill
local pace     = own.speed * (1 - 0.4 * clamp((density_here - 1) / 7, 0, 1))

return machine {
  name = "tawaf", version = 1, start = "Enter",
  defaults = { speed = normal(1.0, 0.15, 0.5, 2.0), perception = 3, horizon = 0.5, radius = 0.19 },
  counts   = { laps = circuits "kaaba" },               -- net turns since the line was first crossed

  states = {
    Enter = { steer = orbit "kaaba", speed = pace,
      { to = "Istilam", when = at_line, chance = 0.38 },
      { to = "Circle",  when = at_line } },

    Circle = { steer = orbit "kaaba", speed = pace,
      { to = "Exit",    when = mine.laps:at_least(7) },
      { to = "ToStone", when = at_line & near("black_stone", 10) & ~crowded & ~mine.touched, chance = 0.03 },
      { to = "Istilam", when = at_line, chance = 0.38 } },

    ToStone = { steer = queue "black_stone", speed = 0.3 * own.speed, perception = 1, push = shove,
      { to = "Touch",   when = near("black_stone", 0.75) },
      { to = "Circle",  when = after(60) | stuck(15) } },

    Touch = { steer = hold, lasts = 3, on_exit = function(me) me.touched = true end,
      { to = "Circle",  when = lasted } },

    -- Facing the stone on passing it slows people down; only a hard cap does that in a stream.
    Istilam = { steer = orbit "kaaba", face = "black_stone", speed = pace, max_speed = 0.5, lasts = uniform(4.5, 13.5),
      { to = "Circle",  when = lasted | pushed:above(120) } },

    Exit = { steer = seek(one_of "gates"), speed = pace, push = shove,
      { to = "Gone",    when = inside(goal) } },

    Gone = { removes = true },
  },
}
