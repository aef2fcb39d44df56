-- expects: load-error 1 MB
local s = ("x"):rep(math.maxinteger, ("y"):rep(1000))
