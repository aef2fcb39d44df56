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

test("who comes through a door is out, also through the one that it had not chosen", function()
  local def = hall(1)
  local people = def.groups.people
  people.count, people["in"], people.at = nil, nil, { { -7.5, 10 } }
  -- The far door lies outside, beyond the near one, which those who stand in a room of their own keep people from.
  def.places.far = { line = { { 4, 10 }, { 5, 10 } } }
  def.places.near_front = { polygon = { { -40, 0 }, { -30, 0 }, { -30, 10 }, { -40, 10 } } }
  def.walls = { { line = { { 0, -2 }, { 0, -4 }, { -8, -4 }, { -8, 12 }, { 0, 12 }, { 0, -1 } } } }
  def.groups.standing = { behaviour = "stander.lua", count = 80, ["in"] = "near_front" }
  local s = scene(def)
  s:reaches("ToFar", { agents = "people", within = 8 })
  s:reaches("Walk", { agents = "people", within = 10 })
  local a = s:agents("people")[1]
  truthy(a.x < 0.5 and a.y < 0, "it was out before it reached the other door")
end)

test("who is out by a door that it was not told of goes on, and not round to the one that it knows", function()
  local def = hall(1)
  local people = def.groups.people
  people.count, people["in"], people.at = nil, nil, { { 0.5, 9.5 } }
  people.set.far, people.set.far_front = "near", "near_front"
  local s = scene(def)
  s:reaches("Walk", { agents = "people", within = 0.2 })
  s:run(8)
  equal(s:count(), 0)
end)
