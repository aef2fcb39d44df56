-- expects: load-error
local long = ("speeed"):rep(10000)
while true do local _ = now[long] end
