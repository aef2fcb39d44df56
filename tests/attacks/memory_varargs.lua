-- expects: load-error
local function grow(...) return grow(1, ...) end
grow()
