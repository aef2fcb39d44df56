-- expects: run velocity
return machine { name = "m", start = "A", states = { A = { steer = function() return "1", "2" end } } }
