-- expects: run too long
local t = {}
for i = 1, 30000 do t["k" .. i] = true end
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function()
    while true do pairs(t) end
  end } } } }
