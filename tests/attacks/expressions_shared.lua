-- expects: load-error
-- Thirty doublings of one value: a tree of a billion leaves.
local e = now.speed
for _ = 1, 30 do e = e + e end
return machine { name = "m", start = "A", states = { A = { push = e } } }
