-- row-stander.lua: stands in a row, and is pushed along it rather than out of it.
local function row(behaviour)
  return {
    places = { ahead = { point = { 10, 0 } } },
    groups = {
      row = {
        behaviour = behaviour, at = { { 0, 0 }, { 0.34, 0.01 }, { 0.68, -0.01 }, { 1.02, 0 } }, tags = { "row" },
        set = { mass = 70, breadth = 0.45, depth = 0.25 },
      },
      shover = {
        behaviour = "shover.lua", at = { { -0.34, 0 } },
        set = { ahead = "ahead", at = 0.5, strength = 1500, time = 0.6 },
      },
    },
  }
end

local function moves(behaviour)
  local s = scene(row(behaviour))
  local before = s:agents("row")
  s:run(2)
  local least, aside = math.huge, 0
  for n, a in ipairs(s:agents("row")) do
    least = math.min(least, a.x - before[n].x)
    aside = math.max(aside, math.abs(a.y - before[n].y))
  end
  return least, aside
end

test("a push goes along the row and moves nobody out of it", function()
  local least, aside = moves("row-stander.lua")
  truthy(least > 0.1, "the push reaches the foremost")
  truthy(aside < 0.1, "nobody leaves the row")
end)

test("standers step aside for those who are pushed towards them", function()
  local _, aside = moves("stander.lua")
  truthy(aside > 0.2, "somebody leaves the row")
end)
