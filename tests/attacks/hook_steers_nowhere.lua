-- expects: run velocity
return machine { name = "m", start = "A", states = { A = { steer = function() return 0 / 0, 1 end } } }
