-- expects: load-error unknown word 'rawset'
rawset(math, "pi", 3)
