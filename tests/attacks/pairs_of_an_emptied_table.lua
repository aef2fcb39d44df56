-- expects: load-error too long
-- Nothing is left in it, yet all of its room is looked through.
local t = {}
for i = 1, 30000 do t["k" .. i] = true end
for i = 1, 30000 do t["k" .. i] = nil end
while true do next(t) end
