-- expects: load-error too long
local a = ("x"):rep(2 ^ 20 - 1) .. "a"
local b = ("x"):rep(2 ^ 20 - 1) .. "b"
while true do local _ = a < b end
