-- Runs to a goal through people who stand in the way. By ORCA: not fit for capacities.
-- Looks a short way ahead; its push is `push` N for each m/s of its speed.
return machine {
  name = "runner", version = 1, start = "Run",
  defaults = { speed = 2, max_speed = 2.2, perception = 1.5, horizon = 0.2, push = 300 },

  states = {
    Run = { steer = seek(own.goal), push = own.push * max(now.speed, own.speed),
      { to = "Arrived", when = inside(own.goal) } },

    Arrived = { steer = hold },
  },
}
