-- antipodal.lua: walks to a goal of its own and stops there.
local function circle(count, threads)
  local set = { ["groups.crossing.count"] = count, ["places.centre.radius"] = 12 }
  return scene("circle.yaml", { set = set, threads = threads })
end

test("two change sides in the time that 24 m take", function()
  local s = circle(2)
  local before = { s:agent(0), s:agent(1) }
  s:reaches("Rest", { within = 24 / 1.3 + 3 })
  truthy(s:time() >= 23.5 / 1.3, "nobody is faster than the speed it wants")
  s:run(2)
  for id = 0, 1 do
    local a, b = s:agent(id), before[id + 1]
    near(a.x, -b.x, 0.6)
    near(a.y, -b.y, 0.6)
  end
end)

test("a hundred pass through each other, and all arrive", function()
  local s = circle(100)
  s:reaches("Rest", { within = 80 })
  equal(s:count(), 100)
  equal(s:entered("Walk"), 100)
end)

test("nobody hurries on the way, and nobody rests before the goal is reached", function()
  local s = circle(60)
  near(s:faster_than(1.2, { during = 4 }), 1.3, 0.03) -- they have not met yet
  s:never("Rest", { during = 12 })
  s:slower_than(1.82, { during = 10 }) -- in the crush pushes add to it
end)

test("who was pushed away from its goal walks back to it", function()
  local s = scene {
    places = { spot = { point = { 0, 0 }, radius = 0.3 }, far = { point = { 9, 0 } } },
    groups = {
      rude = { behaviour = "runner.lua", at = { { -4, 0.05 } }, set = { goal = "far", mass = 100 } },
      calm = {
        behaviour = "antipodal.lua", at = { { -0.9, 0.3 } },
        set = { goal = "spot", perception = 0.5, mass = 50 },
      },
    },
  }
  s:reaches("Rest", { agents = "calm", within = 2 })
  s:reaches("Arrived", { agents = "rude", within = 12 })
  s:run(4)
  local calm = s:agents("calm")[1]
  equal(calm.state, "Rest")
  near(calm.x, 0, 0.35)
  near(calm.y, 0, 0.35)
end)

test("a circle is the same on one thread and on three", function()
  local a, b = circle(100), circle(100, 3)
  a:run(15)
  b:run(15)
  equal(a:hash(), b:hash())
end)
