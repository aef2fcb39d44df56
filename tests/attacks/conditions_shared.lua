-- expects: load-error
local c = lasted
for _ = 1, 30 do c = c & c end
return machine { name = "m", start = "A", states = { A = { { to = "A", when = c } } } }
