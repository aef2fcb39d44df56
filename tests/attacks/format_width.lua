-- expects: load-error at most 99
local s = string.format("%2147483648d", 1)
