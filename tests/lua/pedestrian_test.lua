-- pedestrian.lua: to and fro, more slowly where it is denser.
local function ring(count)
  return scene({
    places = {
      lane = { polygon = { { 0, 0 }, { 16, 0 }, { 16, 2 }, { 0, 2 } } },
      west = { polygon = { { -3, 0 }, { 0, 0 }, { 0, 2 }, { -3, 2 } } },
      east = { polygon = { { 16, 0 }, { 19, 0 }, { 19, 2 }, { 16, 2 } } },
    },
    walls = { { line = { { -3, 0 }, { 19, 0 }, { 19, 2 }, { -3, 2 } }, closed = true } },
    groups = {
      people = { behaviour = "pedestrian.lua", count = count, fill = "grid", ["in"] = "lane",
        set = { goal = "east", home = "west" } },
    },
  }, { seed = 1 })
end

test("speed falls with density, and nobody stands for ever", function()
  local few = ring(4):faster_than(0.9, { during = 10 })
  local some = ring(30):faster_than(0.3, { during = 10 })
  local many = ring(70):faster_than(0.02, { during = 10 })
  truthy(few > some + 0.1 and some > many + 0.1, few .. ", " .. some .. ", " .. many .. " m/s")
end)

test("everybody turns round at both ends", function()
  local s = ring(6)
  s:reaches("Back", { within = 40 })
  s:run(40)
  truthy(s:entered("There") == 6 and s:count() == 6)
end)
