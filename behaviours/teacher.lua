-- At the bell sends the class out, leaves last, counts at the assembly point who reports, and tells the warden when all
-- are there, or how many are missing.
local mine = memory { present = 0, missed = 0 }
local here = told "here"
local count_one = { when = here, set = { present = mine.present + 1 } }
local complete = (mine.present - own.enrolled):at_least(0)

return machine {
  name = "teacher", version = 1, start = "Lesson",
  own = { enrolled = 12, room = "room_1", assembly = "yard" },
  defaults = { speed = 1.3, perception = 40 },

  states = {
    Lesson = { steer = hold,
      { to = "Send", when = heard "bell" } },

    Send = { steer = hold, colour = "yellow",
      count_one,
      { every = 2, tell = { neighbours("pupils"):within(9), "out" } },
      { to = "Go", when = after(2.5) & count(own.room):at_most(1) } },

    Go = { steer = field(own.assembly), colour = "yellow",
      count_one,
      { to = "Roll", when = arrived(own.assembly) } },

    Roll = { steer = gather(own.assembly), colour = "orange",
      count_one,
      { to = "Done", when = complete, tell = { nearest "wardens", "complete" } },
      { to = "Miss", when = after(15), set = { missed = own.enrolled - mine.present },
        tell = { nearest "wardens", "missing", number = own.enrolled - mine.present } } },

    Miss = { steer = gather(own.assembly), colour = "vermilion",
      count_one,
      { to = "Done", when = complete, tell = { nearest "wardens", "complete" } } },

    Done = { steer = gather(own.assembly), colour = "green", count_one },
  },
}
