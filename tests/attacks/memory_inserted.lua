-- expects: load-error too long
-- Every insertion moves all that is there.
local t = {}
while true do table.insert(t, 1, t) end
