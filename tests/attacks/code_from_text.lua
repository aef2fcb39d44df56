-- expects: load-error a number cannot be called
load("while true do end")()
