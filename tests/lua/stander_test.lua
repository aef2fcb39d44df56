-- stander.lua: stands where it is; steps aside only as far as it is pushed.
local function block(count, runner)
  return {
    places = {
      block = { polygon = { { -2, -2 }, { 2, -2 }, { 2, 2 }, { -2, 2 } } },
      goal = { point = { 8, 0 }, radius = 0.5 },
    },
    groups = {
      standing = {
        behaviour = "stander.lua", count = count, fill = "grid", ["in"] = "block", spacing = 0.6,
        set = { mass = 70, radius = 0.2 },
      },
      runner = runner and {
        behaviour = "runner.lua", at = { { -6, 0 } },
        set = { mass = 70, radius = 0.2, speed = 2, goal = "goal" },
      },
    },
  }
end

test("left alone, nobody moves at all", function()
  local s = scene(block(25))
  local before = s:agents("standing")
  s:slower_than(1e-6, { during = 10 })
  for n, a in ipairs(s:agents("standing")) do
    near(a.x, before[n].x, 1e-6)
    near(a.y, before[n].y, 1e-6)
  end
  equal(s:count("Stand"), 25)
end)

test("a push moves those in the way, not those aside, and then they stand again", function()
  local s = scene(block(25, true))
  local before = s:agents("standing")
  s:reaches("Arrived", { agents = "runner", within = 12 })
  s:run(5)
  local moved, most = 0, 0
  for n, a in ipairs(s:agents("standing")) do
    local way = math.sqrt((a.x - before[n].x) ^ 2 + (a.y - before[n].y) ^ 2)
    moved = moved + (way > 0.05 and 1 or 0)
    most = math.max(most, way)
  end
  truthy(moved >= 3, "the runner has to push somebody")
  truthy(moved <= 20, "not everybody stands in its way")
  truthy(most < 2.5, "one who stands is not carried along")
  s:slower_than(0.02, { agents = "standing", during = 2 })
end)
