-- expects: run
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function(me) me.x = 3 return false end } } } }
