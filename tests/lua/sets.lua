return machine { name = "sets", version = 1, start = "Go", states = {
  Go = { steer = seek(one_of "ends"), speed = 2, { to = "Pass", when = inside(goal) } },
  Pass = { steer = away_from "post" } } }
