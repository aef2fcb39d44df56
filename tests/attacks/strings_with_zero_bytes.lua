-- expects: load-error
local _ = now["speed\0x"]
return machine { name = "m\0n", start = "A\0", states = { ["A\0B"] = { steer = hold } } }
