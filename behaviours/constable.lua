-- Walks a beat. Runs after whom people call a thief, looks where the thief was last seen, and takes hold.
local mine = memory { suspect = nobody, arrests = 0 }
local report = told "thief"

return machine {
  name = "constable", version = 1, start = "Beat",
  own = { range = "square" },
  defaults = { speed = 1.1, max_speed = 3.5, perception = 18, mass = normal(85, 8) },

  states = {
    Beat = { steer = wander(own.range),
      { to = "Chase", when = report & exists(report.who), set = { suspect = report.who } } },

    Chase = { steer = seek(mine.suspect), approach = mine.suspect, grasp = mine.suspect, grip = 800, speed = 3,
      { when = report }, -- the first case first
      { to = "Hold",   when = same(holding, mine.suspect) },
      { to = "Search", when = ~sees(mine.suspect) } },

    Search = { steer = field(last_seen(mine.suspect)), speed = 2.5,
      { to = "Chase", when = sees(mine.suspect) },
      { to = "Beat",  when = after(10) | near(last_seen(mine.suspect), 1) | ~exists(mine.suspect) } },

    Hold = { steer = hold, approach = holding, grasp = holding, grip = 800,
      { to = "Beat", when = after(3), tell = { holding, "arrest" },
        set = { arrests = mine.arrests + 1, suspect = nobody } },
      { to = "Chase", when = ~exists(holding) } },
  },
}
