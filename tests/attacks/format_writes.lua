-- expects: load-error does not know '%n'
local s = string.format("%n", 1)
