-- expects: load-error too long
repeat until false
