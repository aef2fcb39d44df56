-- expects: load-error
-- Nearly all memory is held, so that each bit of garbage makes Lua look through all of it.
local held = {}
for i = 1, 27 do held[i] = ("x"):rep(2 ^ 20 - i) end
for i = 1, 1e9 do held[28] = ("y"):rep(2 ^ 18 + i % 10) end
