-- expects: load-error unknown word 'debug'
local r = debug.getregistry()
