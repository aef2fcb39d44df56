-- expects: load-error
local s = spread
for _ = 1, 30 do s = s + s end
return machine { name = "m", start = "A", states = { A = { steer = s } } }
