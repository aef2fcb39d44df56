-- Runs for the end zone past tacklers; tears itself away from agents that hold it, or goes down. A person may drive it:
-- it is theirs from then on, and sprints for 1.5 s while the button is held. By ORCA: not fit for capacities.
memory { home = false, down = false }
local driven, button = now.played:above(0), now.button:above(0)

return machine {
  name = "sprinter", version = 2, start = "Run",
  defaults = { speed = normal(5.5, 0.4), max_speed = 7, perception = 8, horizon = 0.8, mass = normal(85, 8) },

  states = {
    Run = { steer = seek(own.zone) + evade,
      { to = "Home", when = inside(own.zone) },
      { to = "Held", when = holders:above(0) },
      { to = "Play", when = driven } },

    Held = { steer = seek(own.zone),
      { to = "Home", when = inside(own.zone) },
      { to = "Down", when = after(1.5) },
      { to = "Run",  when = holders:at_most(0) } },

    Play = { steer = player, damping = 8,
      runs = machine { start = "Jog", states = {
        Jog =    { speed = 5,               { to = "Sprint", when = button } },
        Sprint = { speed = 7, lasts = 1.5,  { to = "Pant",   when = lasted | ~button } },
        Pant =   { speed = 4.5, lasts = 2,  { to = "Jog",    when = lasted } } } },
      { to = "Home", when = inside(own.zone) },
      { to = "Held", when = holders:above(0) } },

    Home = { steer = hold, set = { home = true } },
    Down = { steer = hold, lies = true, set = { down = true } },
  },
}
