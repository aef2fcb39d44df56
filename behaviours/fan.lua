-- Stands before a stage, as near as it can; at a signal "surge" it presses towards the stage for some seconds, and
-- pushes bodies in the way too, such as barriers.
return machine {
  name = "fan", version = 1, start = "Watch",
  own = { stage = "stage" },
  defaults = { speed = normal(0.5, 0.1, 0.3, 0.8), perception = 2, horizon = 0.6, radius = 0.2 },

  states = {
    Watch = { steer = seek(own.stage), face = own.stage,
      { to = "Surge", when = heard "surge" } },

    Surge = { steer = seek(own.stage), speed = 1.2, face = own.stage, horizon = 0.2,
      push = 140, push_toward = own.stage, lasts = uniform(2, 5), colour = "vermilion",
      { to = "Watch", when = lasted } },
  },
}
