-- expects: harmless
local _ = 1e999, 0x7fffffffffffffffffff, 1e-999, 9999999999999999999999, 0x1p-2000
return machine { name = "m", start = "A", states = { A = { steer = hold } } }
