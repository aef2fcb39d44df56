-- expects: run boom
-- A new text each time, so that none is the same as the last.
local state = { steer = hold }
for i = 1, 30 do
  state[i] = { to = "A", id = "t" .. i, when = function(me) error("boom" .. me.time .. me.id .. i) end }
end
return machine { name = "m", start = "A", states = { A = state } }
