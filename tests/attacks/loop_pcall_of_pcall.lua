-- expects: load-error too long
while true do pcall(pcall, pcall, error, "x") end
