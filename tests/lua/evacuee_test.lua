-- evacuee.lua: the alarm goes round by word of mouth, and everybody leaves by the nearest exit.
local function house(heard)
  return {
    places = {
      left = { polygon = { { -3, 4 }, { -1, 4 }, { -1, 6 }, { -3, 6 } } },
      right = { polygon = { { 21, 4 }, { 23, 4 }, { 23, 6 }, { 21, 6 } } },
      exits = { set = { "left", "right" } },
    },
    walls = {
      { line = { { 0, 4 }, { 0, 0 }, { 20, 0 }, { 20, 4 } } },
      { line = { { 0, 6 }, { 0, 10 }, { 20, 10 }, { 20, 6 } } },
      { line = { { 6, 2 }, { 6, 8 } } },
    },
    groups = {
      first = { behaviour = "evacuee.lua", at = { { 8, 5 } }, set = { exits = "exits", alarm = 1 } },
      near = { behaviour = "evacuee.lua", at = { { 9, 6 }, { 11, 5 } }, set = { exits = "exits", alarm = 1000 } },
      far = { behaviour = "evacuee.lua", at = heard and { { 13, 5 } } or { { 40, 5 } },
        set = { exits = "exits", alarm = 1000 } },
    },
  }
end

test("whoever is told leaves, by the nearest exit, round the wall", function()
  local s = scene(house(true))
  s:reaches("Hesitate", { agents = "first", within = 2 })
  s:reaches("Hesitate", { agents = "near", within = 20 })
  s:reaches("Out", { within = 60 })
  equal(s:count(), 0)
end)

test("the first does not leave at once, and does not walk through the wall", function()
  local s = scene(house(true))
  s:reaches("Leave", { agents = "first", within = 17 })
  truthy(s:time() > 1.9, "nobody believes an alarm within a second")
  while s:count("Leave", { agents = "first" }) > 0 do
    local me = s:agents("first")[1]
    truthy(not (math.abs(me.x - 6) < 0.15 and me.y > 2 and me.y < 8), "in the wall")
    s:step()
  end
  equal(s:entered("Out", { agents = "first" }), 1)
end)

test("out of earshot nobody moves", function()
  local s = scene(house(false))
  s:run(40)
  equal(s:entered("Hesitate", { agents = "far" }), 0)
end)
