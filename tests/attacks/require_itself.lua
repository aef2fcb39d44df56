-- expects: load-error
local again = require "require_itself"
return again
