-- Follows the guide at a distance, and stands to listen when the story begins.
local crowd = require "crowd"
local guide = nearest "guides"

return machine {
  name = "tourist", version = 2, start = "Follow",
  defaults = { speed = normal(1.35, 0.15, 1, 1.8), time_gap = crowd.time_gap, perception = 12 },

  states = {
    Follow = { steer = follow(guide, 1.2) + 0.3 * spread,
      { to = "Listen", when = heard("story", 8) },
      { to = "Lost",   when = ~sees(guide) } },

    Listen = { steer = hold, face = guide, lasts = uniform(4, 8),
      { to = "Follow", when = lasted | distance(guide):above(5) } },

    Lost = { steer = hold,
      { to = "Follow", when = sees(guide) } },
  },
}
