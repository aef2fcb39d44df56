-- expects: load-error too long
local t = { 1 }
for i in ipairs(t) do t[i + 1], t[i] = 1, nil end
