-- expects: load-error
local long = ("A"):rep(2 ^ 19)
return machine { name = long, start = long, states = { [long] = { steer = hold, [long] = 1 } } }
