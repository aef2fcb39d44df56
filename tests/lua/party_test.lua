-- party.lua: whoever is quick stands until the slowest has come up.
test("the quick arrive with the slow", function()
  local s = scene({
    places = { goal = { polygon = { { 20, 0 }, { 22, 0 }, { 22, 6 }, { 20, 6 } } } },
    groups = {
      quick = { behaviour = "party.lua", at = { { 1, 1 }, { 1, 3 } }, team = "us",
        set = { goal = "goal", speed = 1.4 } },
      slow = { behaviour = "party.lua", at = { { 1, 2 } }, team = "us", set = { goal = "goal", speed = 0.5 } },
    },
  })
  s:run(20)
  local least, most = math.huge, -math.huge
  for _, a in ipairs(s:agents()) do least, most = math.min(least, a.x), math.max(most, a.x) end
  truthy(most - least < 4, most - least .. " m apart after 20 s, where the quick would be 18 m ahead")
  s:reaches("Gone", { within = 60 })
end)
