-- expects: harmless
local t = {}
for i = 1, 200 do t[i] = 200 - i end
table.sort(t, function(a, b)
  for i = 1, 300 do t[i] = nil end
  t[1e9] = {}
  return a < b
end)
assert(t[1] == 0 and t[200] == 199)
return machine { name = "m", start = "A", states = { A = { steer = hold } } }
