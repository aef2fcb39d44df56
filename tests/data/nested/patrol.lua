-- Goes to and fro between two posts, and ends after some rounds: alone, or run by states of other behaviours.
local mine = memory { rounds = 0 }

return machine {
  name = "patrol", version = 1, start = "Walk",
  defaults = { speed = uniform(1, 1.6), perception = 4, horizon = 0.8 },

  states = {
    Walk = { steer = seek "east",
      { to = "Look", when = near("east", 1) | after(0.25), set = { rounds = mine.rounds + 1 } } },

    Look = { steer = hold, lasts = uniform(0.05, 0.15),
      { to = "End",  when = lasted & mine.rounds:at_least(3) },
      { to = "Walk", when = lasted } },

    End = { ends = true },
  },
}
