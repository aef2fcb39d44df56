-- streamer.lua: walks on the way a line points, by ORCA; one-way.yaml and counterflow.yaml are streams of such people.
local function mean(people, figure)
  local sum = 0
  for _, agent in ipairs(people) do sum = sum + agent[figure] end
  return sum / #people
end

test("whoever meets nobody keeps the speed it wants, round and round", function()
  local s = scene("one-way.yaml", { set = { ["groups.people.count"] = 30 } })
  local before = s:agents("people")
  s:run(20)
  local after = s:agents("people")
  near(mean(after, "now"), 1.3, 0.01)
  for i = 1, 30 do
    near((after[i].x - before[i].x) % 100, 26, 0.3)
    near(after[i].y, before[i].y, 0.1)
  end
end)

test("a crowd that streams one way is hardly slower", function()
  local s = scene("one-way.yaml", { set = { ["groups.people.count"] = 1020, ["places.field.polygon.1.0"] = 10,
    ["places.field.polygon.2.0"] = 10, ["places.eastward.line.1.0"] = 10, ["bounds.1.0"] = 10 } })
  s:run(3)
  truthy(mean(s:agents("people"), "now") > 1.2)
end)

test("two streams at 6 per square metre hold each other up", function()
  local s = scene("counterflow.yaml", { set = { ["groups.eastward.count"] = 300, ["groups.westward.count"] = 300,
    ["places.field.polygon.1.0"] = 6, ["places.field.polygon.2.0"] = 6, ["places.between.polygon.1.0"] = 6,
    ["places.between.polygon.2.0"] = 6, ["places.eastward.line.1.0"] = 6, ["places.westward.line.0.0"] = 6,
    ["bounds.1.0"] = 6 } })
  s:run(5)
  truthy(mean(s:agents("eastward"), "now") < 0.6)
  truthy(mean(s:agents("westward"), "now") < 0.6)
end)
