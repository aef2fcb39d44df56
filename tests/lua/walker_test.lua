-- walker.lua: walks to a goal as fast as the way ahead allows, and leaves there.
local function lane(count)
  return {
    places = {
      lane = { polygon = { { 0, 0 }, { 10, 0 }, { 10, 2 }, { 0, 2 } } },
      goal = { point = { 14, 1 }, radius = 1 },
    },
    walls = { { line = { { -1, 0 }, { 15, 0 } } }, { line = { { -1, 2 }, { 15, 2 } } } },
    groups = {
      people = { behaviour = "walker.lua", count = count, fill = "grid", ["in"] = "lane", set = { goal = "goal" } },
    },
  }
end

test("one walker leaves at its goal, at its own speed", function()
  local s = scene(lane(1), { seed = 3 })
  s:run(3)
  near(s:agent(0).now, s:agent(0).speed, 0.05)
  truthy(s:agent(0).speed >= 0.6 and s:agent(0).speed <= 2.2)
  s:reaches("Gone", { within = 12 })
  equal(s:count(), 0)
end)

test("in a crowd people are slower than alone", function()
  local alone, crowd = scene(lane(1)), scene(lane(60))
  truthy(alone:faster_than(0.5, { during = 4 }) > crowd:faster_than(0.2, { during = 4 }) + 0.2)
  crowd:reaches("Gone", { within = 90 })
end)

test("two runs are the same to the last bit, on one thread and on two", function()
  local a, b = scene(lane(40)), scene(lane(40), { threads = 2 })
  a:run(5)
  b:run(5)
  equal(a:hash(), b:hash())
end)

test("a goal that is no place is refused", function()
  local bad = lane(2)
  bad.groups.people.set = { gaol = "goal" }
  refused(bad, "has no 'gaol'")
end)

test("behind a slow walker one falls back to its speed, a second's walk behind", function()
  local s = scene {
    places = { goal = { point = { 30, 0 }, radius = 1 } },
    walls = { { line = { { -3, 0.3 }, { 35, 0.3 } } }, { line = { { -3, -0.3 }, { 35, -0.3 } } } },
    groups = {
      first = { behaviour = "walker.lua", at = { { 0, 0 } }, set = { goal = "goal", speed = 0.6 } },
      second = { behaviour = "walker.lua", at = { { -3, 0 } }, set = { goal = "goal", speed = 1.8 } },
    },
  }
  s:run(0.5)
  near(s:agents("second")[1].now, 1.8, 0.15)
  s:run(8)
  local first, second = s:agents("first")[1], s:agents("second")[1]
  near(first.now, 0.6, 0.03)
  near(second.now, 0.6, 0.05)
  near(first.x - second.x, 0.95 * 0.6 + 0.4, 0.2)
end)
