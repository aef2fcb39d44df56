-- expects: load-error 1 MB
local s = ("x"):rep(1e9)
