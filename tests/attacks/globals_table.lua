-- expects: load-error unknown word '_G'
_G.x = 1
