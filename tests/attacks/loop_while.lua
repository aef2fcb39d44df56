-- expects: load-error too long
while true do end
