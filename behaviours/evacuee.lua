-- Hears the alarm, takes some time to believe it, passes it on, and leaves by the nearest exit, round the walls.
return machine {
  name = "evacuee", version = 1, start = "Work",
  defaults = { speed = normal(1.3, 0.2, 0.7, 2), perception = 6, horizon = 0.6 },

  states = {
    Work = { steer = hold,
      { to = "Hesitate", when = after(own.alarm) },
      { to = "Hesitate", when = heard("alarm", 5) } },

    -- The time before people move is long and differs much: it decides more than their speed.
    Hesitate = { steer = hold, lasts = normal(6, 3, 1, 15),
      { to = "Leave",    when = lasted } },

    Leave = { steer = field(own.exits), signal = { "alarm", every = 1 },
      push = 60 * max(now.speed, 0.5), push_when = stuck(2),
      { to = "Out",      when = inside(own.exits) } },

    Out = { removes = true },
  },
}
