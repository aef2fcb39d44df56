-- expects: load-error
local e = now.speed
for _ = 1, 90000 do e = -e end
return machine { name = "m", start = "A", states = { A = { push = e } } }
