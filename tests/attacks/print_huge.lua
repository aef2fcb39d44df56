-- expects: harmless
print(("x"):rep(2 ^ 20), ("y"):rep(2 ^ 20))
print(table.unpack({}, 1, 200))
return machine { name = "m", start = "A", states = { A = { steer = hold } } }
