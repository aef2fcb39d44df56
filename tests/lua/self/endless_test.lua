-- What never ends: each takes its whole budget of instructions. Read as fails_test.lua is.
-- luacheck: ignore 113 241 331 511 512
test("no end", function()
  while true do end --> it ran for too long (over its budget of instructions) and was stopped
end)
test("no end behind pcall", function()
  repeat local caught = pcall(function() while true do end end) until caught --> it ran for too long
end)
test("no end behind fails", function()
  fails(function() while true do end end, "")
end) --> it ran for too long
test("no end of memory", function() --> and was stopped
  local all = {}
  for n = 1, 1e9 do all[n] = string.rep("x", 1000) .. n end
end)
