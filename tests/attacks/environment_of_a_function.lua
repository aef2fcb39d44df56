-- expects: load-error '_ENV' cannot be used
local function f(_ENV) return x end
return f({ x = 1 })
