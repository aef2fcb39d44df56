-- expects: load-error
local states = {}
for i = 1, 100000 do states["S" .. i] = { steer = hold } end
return machine { name = "m", start = "S1", states = states }
