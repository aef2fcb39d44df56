-- expects: load-error too long
local t = {}
for i = 1, 5000 do t[i * 3] = i end
local k
while true do k = next(t, k) end
