-- walker.lua: walks to a goal as fast as the way ahead allows, and leaves there.
local function lane(count)
  return {
    places = {
      lane = { polygon = { { 0, 0 }, { 10, 0 }, { 10, 2 }, { 0, 2 } } },
      goal = { point = { 14, 1 }, radius = 1 },
    },
    walls = { { line = { { -1, 0 }, { 15, 0 } } }, { line = { { -1, 2 }, { 15, 2 } } } },
    groups = {
      people = { behaviour = "walker.lua", count = count, fill = "grid", ["in"] = "lane", set = { goal = "goal" } },
    },
  }
end

test("one walker leaves at its goal, at its own speed", function()
  local s = scene(lane(1), { seed = 3 })
  s:run(4)
  near(s:agent(0).now, s:agent(0).speed, 0.05 * s:agent(0).speed)
  truthy(s:agent(0).speed >= 0.6 and s:agent(0).speed <= 2.2)
  s:reaches("Gone", { within = 12 })
  equal(s:count(), 0)
end)

test("in a crowd people are slower than alone", function()
  local alone, crowd = scene(lane(1)), scene(lane(60))
  truthy(alone:faster_than(0.5, { during = 4 }) > crowd:faster_than(0.2, { during = 4 }) + 0.2)
  crowd:reaches("Gone", { within = 90 })
end)

test("two runs are the same to the last bit, on one thread and on two", function()
  local a, b = scene(lane(40)), scene(lane(40), { threads = 2 })
  a:run(5)
  b:run(5)
  equal(a:hash(), b:hash())
end)

-- One person on the way up or down steps that rise by half a metre per metre, with more of `set` and of the stair.
local function climber(up, set, stair)
  local steps = { from = "ground", to = "ground", path = { { 2, 1 }, { 12, 1 } }, width = 2, rise = 5 }
  if not up then steps.path = { { 12, 1 }, { 2, 1 } } end
  for key, value in pairs(stair or {}) do steps[key] = value end
  local all = { goal = "goal", speed = 1.34 }
  for key, value in pairs(set or {}) do all[key] = value end
  local s = scene({
    storeys = { ground = { height = 0 } }, stairs = { steps = steps },
    places = { goal = { point = { 16, 1 }, radius = 1 } },
    groups = { people = { behaviour = "walker.lua", at = { { 1, 1 } }, set = all } },
  })
  s:run(5)
  return s
end

test("up and down stairs people walk as slowly as measured", function()
  near(climber(true):agent(0).now, 0.456 * 1.34, 0.02)
  near(climber(false):agent(0).now, 0.570 * 1.34, 0.02)
end)

test("an own speed on stairs is along the slope, and not for ramps", function()
  local along = math.sqrt(1 + 0.5 * 0.5)
  near(climber(true, { stair_up = 0.5 }):agent(0).now * along, 0.5, 0.02)
  near(climber(false, { stair_down = 0.9 }):agent(0).now * along, 0.9, 0.02)
  near(climber(false, { stair_up = 0.5 }):agent(0).now, 0.570 * 1.34, 0.02)
  near(climber(true, { stair_up = 0.5 }, { kind = "ramp" }):agent(0).now, 0.456 * 1.34, 0.02)
end)

test("an escalator carries those who stand on it, and those who walk besides", function()
  local function progress(set, stair)
    stair.kind = "escalator"
    local s = climber(stair.way == "up", set, stair)
    local from = s:agent(0).x
    s:run(2)
    return (s:agent(0).x - from) / 2 * math.sqrt(1 + 0.5 * 0.5)
  end
  near(progress({ escalator_walk = 0 }, { way = "up" }), 0.5, 0.02)
  near(progress({ escalator_walk = 0 }, { way = "down", speed = 0.65 }), 0.65, 0.02)
  near(progress({ escalator_walk = 1, stair_up = 0.6 }, { way = "up" }), 1.1, 0.03)
end)

test("a goal that is no place is refused", function()
  local bad = lane(2)
  bad.groups.people.set = { gaol = "goal" }
  refused(bad, "has no 'gaol'")
end)

test("behind a slow walker one falls back to its speed, and keeps a time gap", function()
  local s = scene {
    places = { goal = { point = { 60, 0 }, radius = 1 } },
    walls = { { line = { { -8, 0.25 }, { 65, 0.25 } } }, { line = { { -8, -0.25 }, { 65, -0.25 } } } },
    groups = {
      first = { behaviour = "walker.lua", at = { { 0, 0 } }, set = { goal = "goal", speed = 0.6 } },
      second = { behaviour = "walker.lua", at = { { -7, 0 } }, set = { goal = "goal", speed = 1.8 } },
    },
  }
  s:run(2.5)
  local fast = s:agents("second")[1].now
  truthy(fast > 1.2, "it begins faster: " .. fast)
  s:run(20)
  local from = s:agents("second")[1].x
  s:run(10)
  local first, second = s:agents("first")[1], s:agents("second")[1]
  near(first.now, 0.6, 0.03)
  near((second.x - from) / 10, 0.6, 0.06)
  local gap = (first.x - second.x - 2 * 0.19) / 0.6
  truthy(gap > 0.3 and gap < 2, "a time gap of " .. gap .. " s")
end)

-- A room with doors in its right wall; each door: { y, width }.
local function room(doors, count)
  local walls, from = { { line = { { 10, 0 }, { 0, 0 }, { 0, 8 }, { 10, 8 } } } }, 0
  for _, door in ipairs(doors) do
    walls[#walls + 1] = { line = { { 10, from }, { 10, door[1] - door[2] / 2 } } }
    from = door[1] + door[2] / 2
  end
  walls[#walls + 1] = { line = { { 10, from }, { 10, 8 } } }
  return {
    places = {
      hall = { polygon = { { 1, 1 }, { 8, 1 }, { 8, 7 }, { 1, 7 } } },
      front = { polygon = { { 5, 5 }, { 9, 5 }, { 9, 8 }, { 5, 8 } } },
      goal = { polygon = { { 12, -2 }, { 14, -2 }, { 14, 10 }, { 12, 10 } } },
    },
    walls = walls,
    groups = {
      people = { behaviour = "walker.lua", count = count, fill = "grid", ["in"] = "hall", set = { goal = "goal" } },
    },
  }
end

-- Seconds until all are gone.
local function empties(s, within)
  while s:count() > 0 and s:time() < within do s:run(0.5) end
  equal(s:count(), 0)
  return s:time()
end

test("a wider door lets people out sooner", function()
  local before
  for _, width in ipairs { 0.8, 1.2, 2.4 } do
    local time = empties(scene(room({ { 4, width } }, 60)), 200)
    truthy(not before or time < 0.9 * before, width .. " m: " .. time .. " s")
    before = time
  end
end)

test("of two doors both are used, though one is nearer to all", function()
  local two = room({ { 1.5, 1 }, { 6.5, 1 } }, 80)
  two.groups.people["in"], two.groups.people.fill = "front", "hex"
  local s, last, by = scene(two), {}, { near = 0, far = 0 }
  while s:count() > 0 and s:time() < 200 do
    for _, a in ipairs(s:agents()) do
      if a.x > 10 and last[a.id] and last[a.id] <= 10 then
        by[a.y > 4 and "near" or "far"] = by[a.y > 4 and "near" or "far"] + 1
      end
      last[a.id] = a.x
    end
    s:run(0.25)
  end
  equal(s:count(), 0)
  truthy(by.near >= 10 and by.far >= 10, by.near .. " by the nearer one, " .. by.far .. " by the other")
end)

test("people get round a bend, and nobody stands in it for ever", function()
  local s = scene {
    places = {
      start = { polygon = { { 0, 0 }, { 6, 0 }, { 6, 2 }, { 0, 2 } } },
      goal = { polygon = { { 8, 10 }, { 10, 10 }, { 10, 12 }, { 8, 12 } } },
    },
    walls = {
      { line = { { 0, 2 }, { 0, 0 }, { 10, 0 }, { 10, 12 }, { 8, 12 }, { 8, 2 }, { 0, 2 } } },
    },
    groups = {
      people = { behaviour = "walker.lua", count = 40, fill = "grid", ["in"] = "start", set = { goal = "goal" } },
    },
  }
  empties(s, 90)
end)

test("people go round one who stands in their way", function()
  local standing = lane(20)
  standing.groups.standers = { behaviour = "stander.lua", at = { { 11, 1.2 } } }
  local s = scene(standing)
  s:reaches("Gone", { agents = "people", within = 90 })
end)

test("people take a corridor rather than stairs that are shorter, and slower", function()
  local s = scene("../../scenes/rimea-14.yaml")
  s:run(12)
  for id = 0, 9 do
    equal(s:agent(id).storey, "upper")
    truthy(s:agent(id).y > 3.5)
  end
end)
