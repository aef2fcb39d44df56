-- expects: load-error print is limited
while true do print("flood") end
