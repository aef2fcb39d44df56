-- Stands, then gives whoever is ahead one shove.
return machine {
  name = "shover", version = 1, start = "Wait",
  defaults = { perception = 1, horizon = 0.2 },

  states = {
    Wait = { steer = hold,
      { to = "Shove", when = after(own.at) } },

    Shove = { steer = hold, push_toward = own.ahead, push = own.strength, push_reach = 0.5, lasts = own.time,
      { to = "Done", when = lasted } },

    Done = { steer = hold },
  },
}
