-- expects: load-error
local e = now.speed
while true do e = e + now.speed * 2 end
