-- expects: load-error lacks a value
local s = string.format(("%s"):rep(50), 1)
