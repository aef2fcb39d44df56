-- expects: run ?[2J
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function() error("\27[2J\7") end } } } }
