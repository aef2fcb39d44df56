-- expects: run
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function(me) table.insert(me, 1) return false end } } } }
