-- expects: load-error unknown word 'loadfile'
local f = loadfile("/etc/passwd")
