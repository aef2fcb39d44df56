-- expects: run too long
local t = {}
for i = 1, 40000 do t[i * 65535] = i end
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function()
    while true do local _ = t[65535], t[20000 * 65535], t[40000 * 65535] end
  end } } } }
