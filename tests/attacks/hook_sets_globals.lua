-- expects: run globals
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function() hidden = 1 return false end } } } }
