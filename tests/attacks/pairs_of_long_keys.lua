-- expects: load-error too long
-- Keys that differ in their last byte only.
local t, stem = {}, ("x"):rep(10000)
for i = 1, 1000 do t[stem .. i] = i end
while true do pairs(t) end
