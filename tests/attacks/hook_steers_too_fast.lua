-- expects: run velocity
return machine { name = "m", start = "A", states = { A = { steer = function() return math.huge, -1e300 end } } }
