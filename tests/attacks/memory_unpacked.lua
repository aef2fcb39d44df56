-- expects: load-error 200
local t = {}
local a = { table.unpack(t, 1, 1e6) }
