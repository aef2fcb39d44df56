-- expects: load-error
-- Integers that fall upon one another in a hash table: each look-up walks through them all.
local t = {}
for i = 1, 40000 do t[i * 65535] = i end
local n = 0
while true do n = n + t[65535] + t[20000 * 65535] + t[40000 * 65535] end
