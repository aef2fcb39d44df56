-- expects: load-error
local c = {}
for i = 1, 50000 do c["count" .. i] = circuits "yard" end
return machine { name = "m", start = "A", counts = c, states = { A = {} } }
