-- leaver.lua, passer.lua and chooser.lua: through doors.
local outside = { { 6, -3 }, { 7, -3 }, { 7, 3 }, { 6, 3 } }
local room = { polygon = { { -6, -3 }, { -1, -3 }, { -1, 3 }, { -6, 3 } } }

local function walls(half)
  return {
    { line = { { 0, half }, { 0, 3.5 }, { -7, 3.5 }, { -7, -3.5 }, { 0, -3.5 }, { 0, -half } } },
  }
end

test("everybody comes through a door of 0.8 m, spread across it", function()
  local s = scene {
    places = { room = room, door = { line = { { 0, 0.4 }, { 0, -0.4 } } }, goal = { polygon = outside } },
    walls = walls(0.4),
    groups = { people = { behaviour = "leaver.lua", count = 40, ["in"] = "room", set = { door = "door", goal = "goal" } } },
  }
  s:run(60)
  equal(s:count(), 0)
end)

test("who passes an entrance goes on to the exit", function()
  local s = scene {
    places = {
      room = room,
      entrance = { line = { { 0, 0.5 }, { 0, -0.5 } } },
      exit = { line = { { 4, 0.5 }, { 4, -0.5 } } },
      goal = { polygon = outside },
    },
    walls = walls(0.5),
    groups = {
      people = { behaviour = "passer.lua", count = 20, ["in"] = "room",
        set = { entrance = "entrance", exit = "exit", goal = "goal" } },
    },
  }
  s:reaches("ToExit", { within = 10, any = true })
  s:run(40)
  equal(s:count(), 0)
end)

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
    equal(few:count("AtFar") + few:count("ToFar"), 0)
  end
  local many = scene(hall(80))
  many:reaches("AtFar", { within = 30, any = true })
  many:run(60)
  equal(many:count(), 0)
end)
