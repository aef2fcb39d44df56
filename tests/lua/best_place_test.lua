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
