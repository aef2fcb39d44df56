-- expects: stop too long
-- Each look-up walks through thousands of keys.
local step, t = 8191 * 16383 * 32767, {}
for i = 1, 4000 do t[i * step] = i end
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function()
    while true do local _ = t[step], t[2000 * step], t[4000 * step] end
  end } } } }
