-- expects: load-error at load use
local x = math.random()
