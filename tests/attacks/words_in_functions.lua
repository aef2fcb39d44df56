-- expects: run value of the machine's table
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function() return after(3) end } } } }
