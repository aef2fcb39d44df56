-- Walks to a goal by the shortest way round walls, as fast as the free way ahead allows, and leaves there.
local crowd = require "crowd"

return machine {
  name = "walker", version = 2, start = "Walk",
  defaults = { speed = normal(1.34, 0.26, 0.6, 2.2), perception = 3, radius = 0.19 },

  states = {
    Walk = { steer = field(own.goal), speed = crowd.by_headway, horizon = crowd.foresight,
      push = crowd.nudge, push_when = crowd.held_up,
      { to = "Gone", when = inside(own.goal) } },

    Gone = { removes = true },
  },
}
