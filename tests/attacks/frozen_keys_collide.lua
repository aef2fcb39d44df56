-- expects: load-error too long
-- Freezing what functions reach looks each key up.
local step, t = 8191 * 16383 * 32767, {}
for i = 1, 24000 do t[i * step] = i end
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function() return t[1] ~= nil end } } } }
