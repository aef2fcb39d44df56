-- expects: run
local make = machine
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function() for _ = 1, 1000 do make {} end return false end } } } }
