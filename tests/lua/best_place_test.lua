-- `best_place` chooses a member of a set of places by a score over it.
local function choose(score, set, as)
  return scene {
    places = { a = { polygon = { { 9, -2 }, { 12, -2 }, { 12, 2 }, { 9, 2 } } },
      b = { polygon = { { -12, -2 }, { -9, -2 }, { -9, 2 }, { -12, 2 } } }, exits = { set = { "a", "b" } } },
    groups = {
      crowd = { ["in"] = "a", count = 4, behaviour = [[
        return machine { name = "crowd", start = "Stand", states = { Stand = { steer = hold } } }]] },
      leaver = { at = { { 0, 0 } }, set = as, behaviour = [[
        local mine = memory { way = nobody, far = 0 }
        return machine { name = "leaver", start = "Choose", states = {
          Choose = { { to = "Go", set = { way = best_place(]] .. set .. [[, ]] .. score .. [[) } } },
          Go = { steer = field(mine.way), { to = "ByA", when = inside "a" }, { to = "ByB", when = inside "b" } },
          ByA = { steer = hold }, ByB = { steer = hold } } }]] } } }
end

test("people choose the exit with fewer people", function()
  choose("0 - distance(other) - 3 * count(other)", '"exits"'):reaches("ByB", { within = 15, agents = "leaver" })
end)

test("of exits with the same score they choose the first", function()
  choose("0 - distance(other)", '"exits"'):reaches("ByA", { within = 15, agents = "leaver" })
end)

test("the set may be one that the scene gives the group", function()
  choose("0 - count(other)", "own.exits", { exits = "exits" }):reaches("ByB", { within = 15, agents = "leaver" })
end)

test("a person is no place", function()
  refused({ groups = { people = { at = { { 0, 0 } }, behaviour = [[
    local mine = memory { friend = nobody }
    return machine { name = "people", start = "A", states = {
      A = { steer = hold, set = { friend = best("anyone", count(other)) } } } }]] } } }, "best_place")
  refused({ groups = { people = { at = { { 0, 0 } }, behaviour = [[
    local mine = memory { way = nobody }
    return machine { name = "people", start = "A", states = {
      A = { steer = hold, set = { way = best_place(nearest "anyone", 1) } } } }]] } } }, "must be a place")
end)

test("memory and messages take a place that is drawn", function()
  local s = scene {
    places = { a = { point = { 9, 0 } }, b = { point = { -9, 0 } }, c = { point = { 0, 9 } },
      spots = { set = { "a", "b", "c" } }, yard = { polygon = { { -3, -3 }, { 3, -3 }, { 3, 3 }, { -3, 3 } } } },
    groups = { people = { ["in"] = "yard", count = 30, behaviour = [[
      local mine = memory { spot = nobody, other = nobody, told_of = nobody }
      return machine { name = "people", start = "Draw", defaults = { perception = 9, neighbours = 16 }, states = {
        Draw = { steer = hold, { to = "Drawn", when = after(0.1),
          set = { spot = one_of "spots", other = one_of "spots" },
          tell = { neighbours "anyone", "go", to = one_of "spots" } } },
        Drawn = { steer = field(mine.spot), { to = "There", when = near(mine.spot, 1),
          set = { told_of = told("go").to } } },
        There = { steer = hold } } }]] } } }
  s:run(20)
  local count, same, told_of = {}, 0, 0
  for _, one in ipairs(s:agents("people")) do
    count[one.spot] = (count[one.spot] or 0) + 1
    same = same + (one.spot == one.other and 1 or 0)
    told_of = told_of + (one.told_of and 1 or 0)
  end
  for _, name in ipairs { "a", "b", "c" } do truthy(count["place '" .. name .. "'"] >= 4) end
  truthy(same > 2 and same < 20)
  truthy(told_of > 20)
end)

test("a score counts what a condition excludes", function()
  local score = "either(count(other):above(0), -100, 0 - distance(other))"
  choose(score, '"exits"'):reaches("ByB", { within = 15, agents = "leaver" })
end)
