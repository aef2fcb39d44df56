-- expects: harmless
local _ = math.mininteger // -1, math.mininteger % -1, math.abs(math.mininteger), -math.mininteger
_ = math.maxinteger * math.maxinteger, 1 << 200, 1 >> -200, 1 << math.mininteger
_ = math.floor(1e308), math.ceil(-1e308), math.fmod(math.mininteger, -1), math.tointeger(2.0 ^ 63)
_ = ("x"):sub(math.mininteger, math.maxinteger), ("x"):byte(math.maxinteger), ("x"):find("x", math.mininteger)
_ = tonumber(("9"):rep(190)), tonumber("0x" .. ("f"):rep(190)), tonumber(("z"):rep(10000), 36)
_ = pcall(select, math.mininteger, 1), pcall(table.concat, {}, "", math.maxinteger, math.maxinteger)
_ = pcall(table.unpack, {}, math.mininteger, math.maxinteger), pcall(table.insert, {}, math.maxinteger, 1)
_ = pcall(table.move, {}, math.mininteger, math.maxinteger, 0), pcall(table.remove, {}, math.mininteger)
return machine { name = "m", start = "A", states = { A = { steer = hold } } }
