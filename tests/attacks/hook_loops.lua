-- expects: run too long
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function() while true do end end } } } }
