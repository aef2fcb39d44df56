-- The Tawaf: seven circuits of the Kaaba, counted from the start line. By ORCA: not fit for capacities.
local mine     = memory { laps = 0, touched = false, way = 0, greets = true } -- per agent; survives reloads
local at_line  = crosses "start_line"
local greeting = at_line & mine.greets
local crowded  = density("black_stone"):above(6)        -- people per square metre
local eager    = max(now.speed, own.speed)               -- present speed alone cannot break a standstill
local hurry    = 40 * eager                              -- push of agents that circle and are slowed, N
local shove    = (150 + mine.way) * eager                -- push in the queue, N: `way` is what a scene adds
local make_way = (40 + mine.way) * eager                 -- push of agents on their way to a gate, N
local slowed   = now.speed:below(0.8 * own.speed)
local pace     = own.speed * (1 - 0.4 * clamp((density_here - 1) / 7, 0, 1))
local done     = mine.laps:at_least(7)

return machine {
  name = "tawaf", version = 1, start = "Enter",
  defaults = { speed = normal(1.03, 0.15, 0.5, 2.0), perception = 3, horizon = 0.5, radius = 0.19 },
  counts   = { laps = circuits "kaaba" },               -- net turns since the line was first crossed

  states = {
    Enter = { steer = orbit "kaaba", speed = pace, push = hurry, push_when = slowed,
      { to = "Pass",    when = greeting, chance = 0.30 },
      { to = "Circle",  when = at_line } },

    Circle = { steer = orbit "kaaba", speed = pace, push = hurry, push_when = slowed,
      { to = "Outward", when = mine.laps:at_least(6) },
      { to = "ToStone", when = at_line & near("black_stone", 10) & ~crowded & ~mine.touched, chance = 0.03 },
      { to = "Pass",    when = greeting, chance = 0.30 } },

    -- On their last circuit people move outwards.
    Outward = { steer = orbit("kaaba", { inward = 0 }) + 0.5 * away_from "kaaba", speed = pace,
      push = hurry, push_when = slowed,
      { to = "Exit",    when = done },
      { to = "Edge",    when = distance "kaaba":above(36) } },

    Edge = { steer = orbit("kaaba", { inward = 0 }), speed = pace, push = hurry, push_when = slowed,
      { to = "Exit",    when = done } },

    ToStone = { steer = queue "black_stone", speed = 0.3 * own.speed, perception = 1, push = shove,
      { to = "Queue",   when = joined "black_stone" },
      { to = "Circle",  when = after(60) | stuck(15) } },

    Queue = { steer = queue "black_stone", speed = 0.3 * own.speed, perception = 1, push = shove,
      { to = "Touch",   when = first_in "black_stone" & near("black_stone", 0.75) },
      { to = "Circle",  when = after(60) | stuck(15) } },

    Touch = { steer = hold, lasts = 3, on_exit = function(me) me.touched = true end,
      { to = "Circle",  when = lasted } },

    -- People who do not touch the stone greet it from afar on each circuit, and need not stop for that. That 30 % slow
    -- down for it, 4 to 8 m past the line and for 4 to 10 s, is an assumption: we know of no measurement.
    Pass = { steer = orbit "kaaba", speed = pace, lasts = uniform(6, 12),
      { to = "Istilam", when = lasted } },

    -- A hard cap on speed: an agent that only wants to go slower is carried along by the stream.
    Istilam = { steer = orbit "kaaba", face = "black_stone", speed = pace, max_speed = 0.46, lasts = uniform(4, 10),
      { to = "Circle",  when = lasted } },

    -- The gate is drawn at random, as in the paper's Fig. 11; people make for it at once, through the others.
    Exit = { steer = field(one_of "gates"), push = make_way,
      { to = "Gone",    when = inside(goal) } },

    Gone = { removes = true },
  },
}
