-- expects: load-error
local d = {}
for i = 1, 50000 do d["own" .. i] = i end
return machine { name = "m", start = "A", defaults = d, states = { A = {} } }
