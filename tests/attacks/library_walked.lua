-- expects: harmless
for _ in pairs(math) do error("the library is not to be walked") end
assert(next(string) == nil and #table == 0)
return machine { name = "m", start = "A", states = { A = { steer = hold } } }
