-- Walks on, and notes whether somebody is in the way.
return machine { name = "headways", version = 1, start = "Run",
  defaults = { speed = 1, perception = 3 }, states = {
  Run = { steer = along(own.way),
    { to = "Follows", when = after(0.2) & headway:below(2.5) },
    { to = "Free", when = after(0.2) } },
  Follows = { steer = along(own.way) }, Free = { steer = along(own.way) } } }
