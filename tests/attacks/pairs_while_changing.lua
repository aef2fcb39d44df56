-- expects: harmless
local t = { a = 1, b = 2, c = 3 }
for k in pairs(t) do
  t[k] = nil
  for i = 1, 50 do t[k .. i] = i end
end
for _, v in ipairs(t) do t[#t + 1] = v end
return machine { name = "m", start = "A", states = { A = { steer = hold } } }
