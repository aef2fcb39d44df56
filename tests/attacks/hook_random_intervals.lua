-- expects: run interval
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function()
    pcall(math.random, 1e300, 1e300)
    pcall(math.random, -1e300, 1e300)
    pcall(math.random, 0 / 0)
    pcall(math.random, math.mininteger, math.maxinteger)
    return math.random(2, 1) > 0
  end } } } }
