-- expects: run ?[2J
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function() print("\27[2J", "\255\254") return false end } } } }
