-- An infection spreads by touch: people who see an infected person, or hear the signal, flee and hide behind doors. A
-- bitten person turns infected after some seconds, and hunts healthy people whom it sees, until police hold it.
local mine = memory { ill = false }
local infected = nearest("anyone"):in_state("Infected")
local prey = nearest "healthy"
local bitten = touches(infected)

return machine {
  name = "outbreak", version = 1, start = "Calm",
  own = { shelters = "houses", range = "square" },
  defaults = { speed = normal(1.3, 0.15, 0.9, 1.7), max_speed = 3, perception = 9, horizon = 1, radius = 0.2 },

  states = {
    Calm = { steer = wander(own.range), speed = 0.7,
      { to = "Infected", when = mine.ill },
      { to = "Bitten", when = bitten },
      { to = "Flee",   when = sees(infected) },
      { to = "Hide",   when = heard("help", 8) } },

    Flee = { steer = away_from(infected) + 0.5 * field(own.shelters), speed = 2.2, colour = "yellow",
      signal = { "help", every = 1 },
      { to = "Bitten", when = bitten },
      { to = "Hide",   when = ~sees(infected) | distance(infected):above(4) } },

    Hide = { steer = field(own.shelters), speed = 1.9, push = 40, colour = "sky",
      { to = "Bitten", when = bitten },
      { to = "Hidden", when = inside(own.shelters) & after(1.5) },
      { to = "Flee",   when = sees(infected) & distance(infected):below(3) } },

    Hidden = { steer = 0.3 * spread, speed = 0.5, colour = "green",
      { to = "Bitten", when = bitten } },

    Bitten = { steer = hold, lasts = uniform(2, 5), colour = "orange",
      { to = "Infected", when = lasted, set = { tags = "infected", team = "infected" } } },

    Infected = { steer = seek(prey) + 0.5 * wander(), speed = 1.2, push = 50, colour = "purple",
      ignore = { "healthy", "police" },
      { to = "Held",   when = neighbours("police"):at_least(2) & stuck(4) } },

    Held = { steer = hold, colour = "grey" },
  },
}
