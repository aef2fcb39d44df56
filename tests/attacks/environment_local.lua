-- expects: load-error '_ENV' cannot be used
local _ENV <const> = 11
print(x)
