-- expects: load-error would be a global
count = 1
return machine { name = "m", start = "A", states = { A = { steer = hold } } }
