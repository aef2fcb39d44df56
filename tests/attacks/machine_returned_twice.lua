-- expects: harmless
return machine { name = "m", start = "A", states = { A = { steer = hold } } }, machine {}
