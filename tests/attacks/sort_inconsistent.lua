-- expects: harmless
-- No order at all: it ends, and nothing is lost.
for seed = 1, 50 do
  local t, n = {}, seed
  for i = 1, 100 do t[i] = i end
  table.sort(t, function() n = (n * 69069 + 1) % 65536 return n % 3 ~= 0 end)
  local sum = 0
  for i = 1, 100 do sum = sum + t[i] end
  assert(sum == 5050)
end
return machine { name = "m", start = "A", states = { A = { steer = hold } } }
