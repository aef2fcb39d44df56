-- expects: load-error
local function f() error(f()) end
f()
