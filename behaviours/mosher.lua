-- Dances in a pit: runs about in it and into others, and rests at its edge; at a signal "drop" all dance.
local mine = memory { dances = 0 }

return machine {
  name = "mosher", version = 1, start = "Rest",
  own = { pit = "pit", wild = uniform(0.6, 1) },
  defaults = { speed = normal(1.2, 0.2, 0.8, 1.6), max_speed = 4, perception = 3, restitution = 0.4, radius = 0.2 },

  states = {
    Rest = { steer = seek(home), lasts = uniform(3, 9),
      { to = "Dance", when = lasted | heard "drop" } },

    -- The dancer does not avoid others, and pushes those whom it hits hard out of its way.
    Dance = { steer = wander(own.pit), speed = 3 * own.wild, push = 150 * own.wild, ignore = { "mosher", "fan" },
      set = { dances = mine.dances + 1 }, lasts = uniform(4, 10), colour = "purple",
      { to = "Rest", when = lasted } },
  },
}
