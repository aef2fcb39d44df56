-- expects: acts finite number
local mine = memory { n = 0 }
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function(me) me.n = math.huge return false end } } } }
