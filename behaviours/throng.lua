-- Heads for a goal round whatever stands, and stops before what is in the way; held up for a while, it presses.
local crowd = require "crowd"

return machine {
  name = "throng", version = 1, start = "Walk",
  defaults = { speed = normal(1.3, 0.15, 0.8, 1.8), perception = 3, horizon = 0.5 },

  states = {
    Walk = { steer = field(own.goal), speed = crowd.by_headway,
      { to = "Gone",  when = inside(own.goal) },
      { to = "Press", when = stuck(3) } },

    Press = { steer = field(own.goal), push = 110 * max(now.speed, own.speed),
      { to = "Gone",  when = inside(own.goal) },
      { to = "Walk",  when = now.speed:above(0.5 * own.speed) & after(1) } },

    Gone = { removes = true },
  },
}
