-- expects: load-error unknown word 'io'
local f = io.open("/etc/passwd")
