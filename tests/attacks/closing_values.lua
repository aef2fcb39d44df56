-- expects: load-error
local x <close> = {}
