-- expects: run
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function(me) return me[("x"):rep(1000)] or me[{}] or me[0 / 0] end } } } }
