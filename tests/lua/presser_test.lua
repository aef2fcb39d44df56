-- presser.lua: presses towards a goal round the walls. shover.lua: one shove, then nothing.
local function row(strength)
  return {
    step = 0.02,
    places = { ahead = { point = { 10, 0 } } },
    groups = {
      crowd = { behaviour = "stander.lua", at = { { 0, 0 }, { 0.5, 0 } }, set = { step_back = 0 } },
      shover = {
        behaviour = "shover.lua", at = { { -0.5, 0 } },
        set = { ahead = "ahead", at = 0.5, strength = strength, time = 0.4 },
      },
    },
  }
end

test("a presser goes round a wall, through whoever stands there, and is gone at its goal", function()
  local s = scene({
    places = { goal = { point = { 6, 0 }, radius = 0.5 } },
    walls = { { line = { { 3, -2 }, { 3, 2 } } } },
    groups = {
      people = { behaviour = "presser.lua", at = { { 0, 0 } }, set = { goal = "goal" } },
      standing = { behaviour = "stander.lua", at = { { 3, 2.4 }, { 3, -2.4 } } },
    },
  })
  s:run(2.5)
  truthy(math.abs(s:agents("people")[1].y) > 0.3, "round the wall, not against it")
  s:reaches("Gone", { agents = "people", within = 15 })
end)

test("a shove moves those ahead, who push each other, and then it is over", function()
  local s = scene(row(800))
  s:run(0.4)
  equal(s:count("Wait"), 1)
  near(s:agents("crowd")[1].x, 0, 0.01)
  s:run(2.6)
  equal(s:count("Done"), 1)
  local first, second = s:agents("crowd")[1], s:agents("crowd")[2]
  truthy(first.x > 0.1 and second.x > 0.55, "both were moved")
  local before = first.x
  s:run(2)
  near(s:agents("crowd")[1].x, before, 0.05)
end)

test("a stronger shove moves them farther, none moves nobody", function()
  local function moved(strength)
    local s = scene(row(strength))
    s:run(4)
    return s:agents("crowd")[1].x
  end
  near(moved(0), 0, 0.001)
  truthy(moved(1200) > moved(400) + 0.05, "harder is farther")
end)
