-- strider.lua: walks on the way a line points; keeps its distance to those who walk the same way, and meets the others.
local function corridor(groups, length)
  return {
    bounds = { { 0, -2 }, { length, 2 } },
    periodic = "x",
    places = {
      east = { line = { { 0, 0 }, { length, 0 } } },
      west = { line = { { length, 0 }, { 0, 0 } } },
    },
    walls = { { line = { { -1, 1 }, { length + 1, 1 } } }, { line = { { -1, -1 }, { length + 1, -1 } } } },
    groups = groups,
  }
end

local function file(count)
  return corridor({
    people = { behaviour = "strider.lua", count = count, fill = "line", ["in"] = "east", set = { way = "east", speed = 1.3 } },
  }, 20)
end

test("a file stands evenly along its line", function()
  local people = scene(file(8)):agents("people")
  for i = 1, 8 do
    near(people[i].x, (i - 0.5) * 2.5, 1e-3)
    near(people[i].y, 0, 1e-6)
  end
end)

test("in single file people are as fast as their headway allows", function()
  for _, count in ipairs { 12, 24, 32 } do
    local s = scene(file(count))
    s:run(20)
    near(s:agents("people")[1].now, math.min(1.3, (20 / count - 2 * 0.19) / 0.88), 0.02)
  end
end)

test("two who come towards each other do not wait for each other", function()
  local s = scene(corridor({
    one = { behaviour = "strider.lua", at = { { 5, 0.01 } }, set = { way = "east", speed = 1.3 } },
    other = { behaviour = "strider.lua", at = { { 9, -0.01 } }, set = { way = "west", speed = 1.3 } },
  }, 30))
  s:run(5)
  truthy(s:agents("one")[1].x > 9.5, "the one is held up")
  truthy(s:agents("other")[1].x < 4.5, "the other is held up")
end)
