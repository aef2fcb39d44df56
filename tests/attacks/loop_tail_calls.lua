-- expects: load-error too long
local function f() return f() end
return f()
