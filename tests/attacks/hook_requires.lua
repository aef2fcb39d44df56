-- expects: run require works
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function() require "honest" return false end } } } }
