-- expects: load-error
local t = {}
for i = 1, 10000 do t["slot" .. i] = i end
local mine = memory(t)
return machine { name = "m", start = "A", states = { A = {} } }
