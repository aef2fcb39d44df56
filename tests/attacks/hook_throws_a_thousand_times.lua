-- expects: run boom
-- Fails in thirty functions of every agent and step.
local function fail() error("boom") end
local state = { steer = hold, on_enter = fail, on_exit = fail }
for i = 1, 30 do state[i] = { to = "A", id = "t" .. i, when = fail } end
return machine { name = "m", start = "A", states = { A = state } }
