-- expects: harmless
local t = { 3, 1, 2 }
assert(not pcall(table.sort, t, function() error("no") end))
assert(not pcall(table.sort, { 1, {}, "x" }))
assert(not pcall(table.sort, t, 7))
assert(t[1] == 3 and t[2] == 1 and t[3] == 2)
return machine { name = "m", start = "A", states = { A = { steer = hold } } }
