-- Walks to a goal round standing people, looks ahead and stops. By ORCA: not fit for capacities.
-- Held up for a while, it presses until it moves again.
local crowd = require "crowd"

local moves = now.speed:above(0.5 * own.speed)
local there = inside(own.goal)

return machine {
  name = "throng", version = 1, start = "Walk",
  defaults = { speed = normal(1.3, 0.15, 0.8, 1.8), perception = 3, horizon = 2 },

  states = {
    Walk = { steer = field(own.goal), speed = crowd.by_headway,
      { to = "Gone",  when = there },
      { to = "Wait",  when = now.speed:below(0.2 * own.speed) & after(1) } },

    Wait = { steer = hold, step_back = 0, lasts = uniform(6, 8), -- keeps the ground that a push gains
      { to = "Press", when = lasted } },

    Press = { steer = field(own.goal), horizon = 0.5, push = 80 * max(now.speed, own.speed),
      { to = "Gone",  when = there },
      { to = "Walk",  when = moves & after(2) } },

    Gone = { removes = true },
  },
}
