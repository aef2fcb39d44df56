-- fan.lua and mosher.lua: a barrier that is pressed away by surges, and a pit that stays a pit.
local SMALL = { set = { ["groups.fans.count"] = 160 } }

test("surges press the barrier towards the stage", function()
  local s = scene("mosh-pit.yaml", SMALL)
  s:run(7)
  local before = s:body("barrier-4").y
  near(before, 0, 0.3)
  s:run(15)
  truthy(s:body("barrier-4").y < before - 0.3, "the barrier has not moved")
end)

test("all dance at a drop, in the pit", function()
  local s = scene("mosh-pit.yaml", SMALL)
  s:run(5.2)
  equal(s:count("Rest"), 0)
  s:run(8)
  local out = 0
  for _, a in ipairs(s:agents("moshers")) do
    if a.state == "Dance" and math.sqrt(a.x ^ 2 + (a.y - 7) ^ 2) > 4.5 then out = out + 1 end
  end
  truthy(out <= 3, out .. " dance far from the pit")
end)
