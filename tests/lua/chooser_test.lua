-- chooser.lua: by the nearer of two doors, or by the farther one where that is sooner.
-- Two doors to the east, a crowd before the nearer one.
local function hall(count)
  return {
    places = {
      south = { polygon = { { -6, -3 }, { -1, -3 }, { -1, 1 }, { -6, 1 } } },
      near = { line = { { 0, -1 }, { 0, -2 } } },
      far = { line = { { 0, 10 }, { 0, 9 } } },
      near_front = { polygon = { { -8, -4 }, { 0, -4 }, { 0, 4 }, { -8, 4 } } },
      far_front = { polygon = { { -8, 4 }, { 0, 4 }, { 0, 12 }, { -8, 12 } } },
      goal = { polygon = { { 6, -4 }, { 7, -4 }, { 7, 12 }, { 6, 12 } } },
    },
    walls = {
      { line = { { 0, -2 }, { 0, -4 }, { -8, -4 }, { -8, 12 }, { 0, 12 }, { 0, 10 } } },
      { line = { { 0, -1 }, { 0, 9 } } },
    },
    groups = {
      people = { behaviour = "chooser.lua", count = count, ["in"] = "south",
        set = { near = "near", far = "far", near_front = "near_front", far_front = "far_front", goal = "goal" } },
    },
  }
end

test("a few all take the nearer door, of a crowd some take the farther one", function()
  local few = scene(hall(4))
  for _ = 1, 20 do
    few:run(0.5)
    equal(few:count("ToFar"), 0)
  end
  local many = scene(hall(80))
  many:reaches("ToFar", { within = 30, any = true })
  many:run(60)
  equal(many:count(), 0)
end)
