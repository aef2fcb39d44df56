-- expects: load-error
return machine { name = "m", start = "A", states = { A = {} } }, machine {}
