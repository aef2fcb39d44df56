-- expects: load-error
local m = { name = "m", start = "A" }
m.states = m
m.A = m
return machine(m)
