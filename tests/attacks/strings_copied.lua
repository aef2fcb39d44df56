-- expects: load-error too long
local s = ("x"):rep(2 ^ 20)
while true do local t = s:upper():reverse():lower() end
