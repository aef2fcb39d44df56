-- expects: load-error unknown word 'os'
local t = os.clock()
