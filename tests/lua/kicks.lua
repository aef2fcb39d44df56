local ball = nearest "ball"
return machine { name = "kicks", version = 1, start = "Run", defaults = { perception = 30 }, states = {
  Run = { steer = seek(ball), approach = ball, ignore = "people", speed = 2,
    kick = { ball, at = "post", impulse = 1 },
    { to = "Pass", when = kicked(ball) } },
  Pass = { steer = drift(0, 1) } } }
