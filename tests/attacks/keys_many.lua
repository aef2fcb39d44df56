-- expects: load-error
local state = {}
for i = 1, 50000 do state["sped" .. i] = i end
return machine { name = "m", start = "A", states = { A = state } }
