-- The condition `arrived`: a place that is full counts as reached by those who stand round it.
local function crowd(words)
  local law = words.walks and "local crowd = require \"crowd\"\n" or ""
  return law .. ([[return machine { name = "meet", start = "Come",
    defaults = { speed = 1.2, perception = 4%s }, states = {
      Come = { steer = seek "post", { to = "There", when = %s } },
      There = { steer = hold, { to = "Home", when = heard "home" } },
      Home = { steer = seek(home) } } }]]):format(words.walks and ", time_gap = crowd.time_gap" or "", words.when)
end

local function meeting(words, more)
  local def = {
    places = { post = { point = { 10, 10 }, radius = 0.5 },
      west = { polygon = { { 0, 4 }, { 6, 4 }, { 6, 16 }, { 0, 16 } } } },
    groups = { people = { behaviour = crowd(words), count = words.count or 30, ["in"] = "west", spacing = 0.8 } },
    events = { { at = 60, signal = "home" } },
  }
  for key, value in pairs(more or {}) do def[key] = value end
  return scene(def, { seed = words.seed })
end

local function farthest(s)
  local most = 0
  for _, a in ipairs(s:agents()) do most = math.max(most, math.sqrt((a.x - 10) ^ 2 + (a.y - 10) ^ 2)) end
  return most
end

for _, walks in ipairs { true, false } do
  local law = walks and "the walking law" or "ORCA"
  for seed = 1, 3 do
    test("all of thirty arrive at a point, close together, by " .. law .. ", seed " .. seed, function()
      local s = meeting { when = [[arrived "post"]], walks = walks, seed = seed }
      s:reaches("There", { within = 40 })
      truthy(farthest(s) < 2.5, ("the last stands %.2f m away"):format(farthest(s)))
    end)
  end
end

test("without the word most press on towards a full point for ever", function()
  local s = meeting { when = [[inside "post"]], walks = true, seed = 1 }
  s:run(50)
  truthy(s:count("There") < 15, s:count("There") .. " of 30 have got into the point")
end)

test("eighty arrive in a corner", function()
  local s = meeting({ when = [[arrived "post"]], walks = true, seed = 1, count = 80 },
    { places = { post = { point = { 10, 10 }, radius = 0.5 },
        west = { polygon = { { 0, 0 }, { 6, 0 }, { 6.4, 11 }, { 0, 11 } } } },
      walls = { { line = { { 0, 11 }, { 11, 11 }, { 11, 0 } } } } })
  s:reaches("There", { within = 60 })
  truthy(farthest(s) < 9, ("the last stands %.2f m away"):format(farthest(s)))
end)

test("who is held up on the way has not arrived", function()
  local s = meeting({ when = [[arrived "post"]], walks = true, seed = 1 },
    { walls = { { line = { { 8, 0 }, { 8, 20 } }, name = "gate" } } })
  s:run(40)
  equal(s:count("There"), 0)
end)

test("nobody arrives behind people who stand elsewhere, or beyond a wall", function()
  local s = scene {
    places = { post = { point = { 10, 10 }, radius = 0.5 } },
    walls = { { line = { { 9, 5 }, { 9, 15 } } } },
    groups = {
      there = { behaviour = "stander.lua", at = { { 9.7, 10 } } },
      row = { behaviour = "stander.lua", at = { { 5, 9.6 }, { 5, 10 }, { 5, 10.4 } } },
      late = { behaviour = crowd { when = [[arrived "post"]] }, at = { { 8.7, 10 }, { 4.5, 10 } } },
    },
  }
  s:run(10)
  equal(s:entered("There"), 0)
end)

test("behind people who were at the place before, they arrive", function()
  local s = scene {
    places = { post = { point = { 10, 10 }, radius = 0.5 } },
    groups = {
      there = { behaviour = "stander.lua", at = { { 10, 10 }, { 10, 10.45 }, { 10, 9.55 } } },
      late = { behaviour = crowd { when = [[arrived "post"]] }, at = { { 5, 10 } } },
    },
  }
  s:reaches("There", { within = 12, agents = "late" })
end)

test("people leave the place, and others find it free", function()
  local s = meeting { when = [[arrived "post"]], walks = true, seed = 2 }
  s:run(80)
  equal(s:entered("Home"), 30)
  truthy(farthest(s) > 4, "nobody went home")
end)
