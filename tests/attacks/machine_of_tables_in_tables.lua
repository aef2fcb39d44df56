-- expects: load-error
local t = {}
for _ = 1, 10000 do t = { t } end
return machine { name = "m", start = "A", states = { A = t } }
