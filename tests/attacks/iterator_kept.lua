-- expects: run kept
-- An iterator that would remember from call to call.
local step = pairs({ 1, 2, 3 })
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function() return step() == 2 end } } } }
