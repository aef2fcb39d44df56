-- expects: run sheet
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function() return after(3) end } } } }
