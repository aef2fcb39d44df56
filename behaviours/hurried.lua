-- In a hurry: looks a short way ahead, pushes hard, gives way little. By ORCA: not fit for capacities.
return machine {
  name = "hurried", version = 1, start = "Walk",
  defaults = { speed = 1.6, max_speed = 2, perception = 1.2, horizon = 0.2, yield = 0.3 },

  states = {
    Walk = { steer = seek(own.goal), push = 200 * max(now.speed, own.speed),
      { to = "Arrived", when = inside(own.goal) } },

    Arrived = { steer = hold },
  },
}
