-- expects: load-error unknown word 'os'
local home = os.getenv("HOME")
