-- strider.lua: walks on the way a line points; keeps its distance to those who walk the same way, and meets the others.
local function corridor(groups, length, half)
  half = half or 1
  return {
    bounds = { { 0, -2 }, { length, 2 } },
    periodic = "x",
    places = {
      east = { line = { { 0, 0 }, { length, 0 } } },
      west = { line = { { length, 0 }, { 0, 0 } } },
    },
    walls = { { line = { { -1, half }, { length + 1, half } } }, { line = { { -1, -half }, { length + 1, -half } } } },
    groups = groups,
  }
end

local function file(count)
  return corridor({
    people = { behaviour = "strider.lua", count = count, fill = "line", ["in"] = "east",
      set = { way = "east", speed = 1.3 } },
  }, 20, 0.25)
end

test("a file stands evenly along its line", function()
  local people = scene(file(8)):agents("people")
  for i = 1, 8 do
    near(people[i].x, (i - 0.5) * 2.5, 1e-3)
    near(people[i].y, 0, 1e-6)
  end
end)

test("in single file people are slower the closer they are, and keep a time gap", function()
  local before
  for _, count in ipairs { 8, 20, 26, 34 } do
    local s, sum = scene(file(count)), 0
    s:run(40)
    for _ = 1, 40 do
      s:run(0.5)
      for _, agent in ipairs(s:agents("people")) do sum = sum + agent.now end
    end
    local speed = sum / 40 / count
    truthy(speed > 0.02 and (not before or speed < before - 0.02), count .. " people: " .. speed .. " m/s")
    local gap = (20 / count - 2 * 0.19) / speed
    truthy(count == 8 or gap > 0.3 and gap < 2, count .. " people: a time gap of " .. gap .. " s")
    before = speed
  end
end)

test("who walks ahead the same way is followed, who comes the other way is not", function()
  local s = scene(corridor({
    behind = { behaviour = "parts/headways.lua", at = { { 5, 0 } }, set = { way = "east" } },
    ahead = { behaviour = "parts/headways.lua", at = { { 7, 0 } }, set = { way = "east" } },
    coming = { behaviour = "parts/headways.lua", at = { { 14, 0 } }, set = { way = "west" } },
    met = { behaviour = "parts/headways.lua", at = { { 12, 0 } }, set = { way = "east" } },
  }, 40))
  s:run(0.5)
  equal(s:agents("behind")[1].state, "Follows")
  equal(s:agents("ahead")[1].state, "Free")
  equal(s:agents("met")[1].state, "Free")
  equal(s:agents("coming")[1].state, "Free")
end)

test("who meets head-on passes on the right", function()
  local s = scene({
    places = { east = { line = { { 0, 0 }, { 10, 0 } } }, west = { line = { { 10, 0 }, { 0, 0 } } } },
    groups = {
      one = { behaviour = "strider.lua", at = { { 0, 0 } }, set = { way = "east" } },
      other = { behaviour = "strider.lua", at = { { 6, 0 } }, set = { way = "west" } },
    },
  })
  local least = 0
  for _ = 1, 160 do
    s:step()
    least = math.min(least, s:agents("one")[1].y)
    if s:agents("one")[1].x > s:agents("other")[1].x then break end
  end
  truthy(s:agents("one")[1].x > s:agents("other")[1].x, "they have passed each other")
  truthy(s:agents("one")[1].y < -0.1 and s:agents("other")[1].y > 0.1, "each on its right")
end)
