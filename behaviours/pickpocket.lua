-- Picks pockets: chooses who carries much and walks slowly, comes up from behind, takes the purse and makes off, until
-- a constable holds it. By ORCA: not fit for capacities.
local mine = memory { mark = nobody, loot = 0 }
local mark = best("strollers", theirs(other, "purse") - 2 * other.speed - 0.3 * distance(other))
local within_reach = near(mine.mark, 0.8)

return machine {
  name = "pickpocket", version = 1, start = "Prowl", public = "loot",
  own = { range = "square" },
  defaults = { speed = normal(1.2, 0.1), max_speed = 3, perception = 12 },

  states = {
    Prowl = { steer = wander(own.range),
      { to = "Held",  when = holders:above(0) },
      { to = "Stalk", when = after(4) & theirs(mark, "purse"):above(0), set = { mark = mark } } },

    Stalk = { steer = follow(mine.mark, 0.5), approach = mine.mark, speed = 1.7,
      { to = "Held",  when = holders:above(0) },
      { to = "Flee",  when = within_reach & theirs(mine.mark, "purse"):above(0),
        set = { loot = mine.loot + theirs(mine.mark, "purse") }, tell = { mine.mark, "robbed" } },
      { to = "Prowl", when = within_reach | ~sees(mine.mark) | after(20), set = { mark = nobody } } },

    Flee = { steer = away_from(mine.mark) + 0.5 * wander(own.range), speed = 2.2,
      { to = "Held",  when = holders:above(0) },
      { to = "Prowl", when = after(8), set = { mark = nobody } } },

    Held = { steer = hold,
      { to = "Led",   when = told "arrest", set = { loot = 0 } },
      { to = "Prowl", when = holders:is(0) & after(2) } },

    Led = { removes = true },
  },
}
