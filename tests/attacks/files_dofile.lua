-- expects: load-error unknown word 'dofile'
dofile("/etc/passwd")
