-- expects: load-error too long
while true do pcall(error, "again") end
