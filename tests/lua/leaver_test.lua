-- leaver.lua: by which of two exits people leave.
local function hall(set, gate)
  for name, value in pairs({ first = "west", second = "east", first_door = "west_door", second_door = "east_door",
    premovement = 0, sway = 0, used_to = 0 }) do
    if set[name] == nil then set[name] = value end
  end
  return {
    places = {
      west = { polygon = { { -3, 4 }, { -1, 4 }, { -1, 6 }, { -3, 6 } } },
      east = { polygon = { { 21, 4 }, { 23, 4 }, { 23, 6 }, { 21, 6 } } },
      west_door = { line = { { 0, 4.5 }, { 0, 5.5 } } },
      east_door = { line = { { 20, 5.5 }, { 20, 4.5 } } },
    },
    walls = {
      { line = { { 0, 4.5 }, { 0, 0 }, { 20, 0 }, { 20, 4.5 } } },
      { line = { { 0, 5.5 }, { 0, 10 }, { 20, 10 }, { 20, 5.5 } } },
      { line = { { 0, 4.5 }, { 0, 5.5 } }, name = "west", open = gate ~= "shut" },
    },
    groups = { people = { behaviour = "leaver.lua", at = { { 7, 4 }, { 8, 6 } }, set = set } },
  }
end

test("the nearer exit, unless one is used to the other", function()
  local s = scene(hall({}))
  s:run(1)
  equal(s:count("ToFirst"), 2)
  s = scene(hall({ used_to = -30 }))
  s:run(1)
  equal(s:count("ToSecond"), 2)
  s:reaches("Out", { within = 40 })
end)

test("others whom one sees lead the way", function()
  local s = scene(hall({ sway = 50, premovement = 3 }))
  s:run(5)
  equal(s:count("ToFirst"), 2)
  local led = hall({ sway = 50, premovement = 3 })
  led.groups.leader = { behaviour = "leaver.lua", at = { { 9, 5 } },
    set = { first = "west", second = "east", first_door = "west_door", second_door = "east_door", premovement = 0,
      sway = 0, used_to = -100 } }
  s = scene(led)
  s:run(5)
  equal(s:count("ToSecond"), 3)
end)

test("who sees that its door is shut turns to the other one", function()
  local s = scene(hall({}, "shut"))
  s:reaches("Out", { within = 60 })
  equal(s:count(), 0)
end)
