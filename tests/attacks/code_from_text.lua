-- expects: load-error unknown word 'load'
load("while true do end")()
