-- expects: load-error
return machine { name = "m", start = "A", states = { A = { speed = 0 / 0, push = math.huge, mass = -1 / 0,
  steer = drift(0 / 0, 1), lasts = math.huge } } }
