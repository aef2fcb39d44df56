-- outbreak.lua and police.lua: an infection, doors, and a line that pushes.
local function healthy(at)
  return { behaviour = "outbreak.lua", at = at, tags = { "healthy" }, team = "people" }
end
local function ill(at)
  return { behaviour = "outbreak.lua", at = at, tags = { "infected" }, team = "infected", memory = { ill = true } }
end
local function police(at)
  return { behaviour = "police.lua", at = at, tags = { "police" }, team = "police" }
end

local function room(more)
  local scene = {
    places = { square = { polygon = { { 0, 0 }, { 20, 0 }, { 20, 10 }, { 0, 10 } } },
      houses = { polygon = { { 0.5, 10.5 }, { 6, 10.5 }, { 6, 15 }, { 0.5, 15 } } },
      line_1 = { line = { { 4, 0 }, { 4, 10 } } }, line_2 = { line = { { 10, 0 }, { 10, 10 } } },
      line_3 = { line = { { 16, 0 }, { 16, 10 } } } },
    walls = { { line = { { 2, 10 }, { 0, 10 }, { 0, 0 }, { 20, 0 }, { 20, 10 }, { 3.2, 10 } } },
      { line = { { 2, 10 }, { 0, 10 }, { 0, 15.5 }, { 6.5, 15.5 }, { 6.5, 10 } } },
      { line = { { 2, 10 }, { 3.2, 10 } }, name = "door", open = true } },
    groups = {
      people = healthy { { 10, 5 }, { 8, 5 }, { 3, 8 } }, infected = ill { { 8.6, 5 } },
      police = police { { 0.5, 1 } } },
  }
  for key, value in pairs(more or {}) do scene[key] = value end
  return scene
end

test("who sees the infected flees, and who is touched turns, and hunts", function()
  local s = scene(room { events = { { at = 0, close = "door" } } })
  s:reaches("Flee", { agents = "people", any = true, within = 3 })
  s:reaches("Infected", { agents = "people", any = true, within = 60 })
  s:run(3)
  equal(s:entered("Bitten", { agents = "infected" }), 0)
end)

test("those behind a shut door are neither seen nor touched", function()
  local s = scene(room { events = { { at = 0.2, close = "door" } }, groups = {
    people = healthy { { 2, 11 }, { 3, 12 } }, infected = ill { { 2.5, 8 } }, police = police { { 15, 1 } } } })
  s:run(30)
  equal(s:count("Infected"), 1)
  equal(s:entered("Bitten"), 0)
end)

test("a line of police pushes the infected before it", function()
  local at = {}
  for n = 1, 20 do at[n] = { 3.9, 0.5 * n - 0.25 } end
  local s = scene(room {
    events = { { at = 0, close = "door" }, { at = 2, signal = "advance" }, { at = 14, signal = "advance" } },
    groups = { people = healthy { { 1, 12 } }, infected = ill { { 6, 3 }, { 7, 6 }, { 8, 8 } }, police = police(at) } })
  s:run(28)
  local pushed = 0
  for _, a in ipairs(s:agents("infected")) do pushed = pushed + (a.x > 14 and 1 or 0) end
  truthy(pushed >= 2, pushed .. " of 3 were pushed back")
  equal(s:count("Last") + s:count("Guard"), 20)
end)
