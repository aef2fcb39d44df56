-- Walks for ever in the direction of a line. By ORCA: not fit for capacities.
return machine {
  name = "streamer", version = 1, start = "Walk",
  defaults = { speed = 1.3, perception = 5, horizon = 2, radius = 0.2 },

  states = {
    Walk = { steer = along(own.way) },
  },
}
