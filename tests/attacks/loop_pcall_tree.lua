-- expects: load-error too long
-- Two calls at each of two hundred levels.
local function f() pcall(f) pcall(f) end
f()
