-- expects: harmless
-- No address is shown, so that runs stay equal and nothing of the process is told.
local shown = tostring({}) .. tostring(print) .. tostring(hold) .. tostring(now) .. tostring(own)
shown = shown .. string.format("%s %s", {}, pairs)
for i = 1, #shown do assert(not shown:sub(i, i + 1):find("0x")) end
assert(not pcall(string.format, "%p", {}))
local ok, why = pcall(function() return {} .. "" end)
assert(not ok and not why:find("0x"))
ok, why = pcall(function() return {} < {} end)
assert(not ok and not why:find("0x"))
return machine { name = "m", start = "A", states = { A = { steer = hold } } }
