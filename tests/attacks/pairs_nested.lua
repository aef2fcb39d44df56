-- expects: load-error too long
-- Every call of pairs puts thousands of keys in order.
local t = {}
for i = 1, 20000 do t["key" .. i] = i end
while true do for _ in pairs(t) do break end end
