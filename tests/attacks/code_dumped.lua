-- expects: load-error
local s = string.dump(function() end)
