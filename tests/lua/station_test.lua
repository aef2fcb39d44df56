-- commuter.lua and wanderer.lua: boarding when the doors open, and people who go where they like.
test("nobody boards before the doors open; then all do, and ride as standers", function()
  local s = scene "station.yaml"
  s:never("Board", { during = 7.9 })
  s:reaches("Board", { agents = "commuters", within = 2 })
  s:reaches("Ride", { agents = "commuters", within = 60 })
  s:run(1)
  equal(s:count("Stand"), 40)
  equal(s:agents("commuters")[1].machine, "stander")
end)

test("whoever becomes another machine keeps its body", function()
  local s = scene("station.yaml", { set = { ["groups.commuters.set.mass"] = 91 } })
  s:reaches("Ride", { agents = "commuters", within = 60, count = 10 })
  s:run(1)
  for _, agent in ipairs(s:agents("commuters")) do
    near(agent.mass, 91, 1e-3)
  end
end)

test("wanderers see more than one place", function()
  local s = scene("station.yaml", { seed = 3 })
  local seen = {}
  for _ = 1, 50 do
    s:run(1)
    for _, agent in ipairs(s:agents("strollers")) do
      if agent.state == "Stay" then
        seen[agent.x < 8 and "kiosk" or agent.x > 22 and "map" or "bench"] = true
      end
    end
  end
  truthy(seen.kiosk and seen.map and seen.bench)
end)
