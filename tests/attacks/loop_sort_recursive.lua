-- expects: load-error
-- The comparator sorts the list that is being sorted.
local t = { 3, 2, 1 }
local function less() table.sort(t, less) return true end
less()
