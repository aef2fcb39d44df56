-- expects: load-error at most 99
local s = string.format("%.99999999999999999999f", 1)
