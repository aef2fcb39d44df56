-- expects: load-error too long
-- The same in tables of 8192, 16384 and 32768 slots.
local step, t = 8191 * 16383 * 32767, {}
for i = 1, 30000 do t[i * step] = i end
while true do local _ = t[step], t[15000 * step], t[30000 * step] end
