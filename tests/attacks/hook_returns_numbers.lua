-- expects: run must return true or false
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function() return 7 end } } } }
