-- expects: load-error memory
for _ = 1, 1e9 do
  pcall(function() local t = {} for i = 1, 1e9 do t[i] = i end end)
end
