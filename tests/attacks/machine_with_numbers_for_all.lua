-- expects: load-error
return machine { name = 1, version = "x", start = 2, defaults = 3, counts = 4, renamed = 5, states = 6 }
