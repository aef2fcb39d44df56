-- runner.lua: runs to a goal through whoever stands in the way.
local function through(options)
  return scene("running-through.yaml", options)
end

test("alone, it runs at the speed it wants and stops at the goal", function()
  local s = scene {
    places = { goal = { point = { 8, 0 }, radius = 0.5 } },
    groups = { runner = { behaviour = "runner.lua", at = { { 0, 0 } }, set = { goal = "goal", speed = 2 } } },
  }
  near(s:faster_than(1.9, { during = 2 }), 2, 0.05)
  s:never("Arrived", { during = 1 })
  near(s:reaches("Arrived", { within = 2 }), 7.5 / 2, 0.2)
  s:run(1.5) -- it does not stop on the spot
  s:slower_than(0.1, { during = 1 })
  near(s:agent(0).x, 7.6, 0.3)
end)

test("a runner in a hurry is held to 2.2 m/s", function()
  local s = scene {
    places = { goal = { point = { 8, 0 }, radius = 0.5 } },
    groups = { runner = { behaviour = "runner.lua", at = { { 0, 0 } }, set = { goal = "goal", speed = 4 } } },
  }
  s:slower_than(2.21, { during = 1 })
  truthy(s:faster_than(2.1, { during = 1 }))
end)

test("it breaks through the block within ten seconds, on a nearly straight line", function()
  local s = through()
  while s:agents("runner")[1].x < 3 do
    truthy(math.abs(s:agents("runner")[1].y) < 0.6, "it goes through, not round the block")
    s:step()
  end
  near(s:reaches("Arrived", { agents = "runner", within = 10 - s:time() }), 7.4, 1)
end)

test("people slow it down, but never stop it", function()
  local s, least, most = through(), 9, 0
  s:run(2)
  repeat
    s:step()
    local runner = s:agents("runner")[1]
    least, most = math.min(least, runner.now), math.max(most, runner.now)
  until runner.x > 1.6
  truthy(least < 1.7, "bodies cost speed")
  truthy(least > 0.1, "250 N for each m/s get it through")
  truthy(most <= 2.25, "never faster than its max_speed of 2.2 m/s")
end)

test("those it meets feel its push, and before that nobody does", function()
  local s = through()
  s:run(2)
  for _, a in ipairs(s:agents("standing")) do
    equal(a.pushed, 0)
  end
  local most = 0
  for _ = 1, 20 do
    s:step()
    for _, a in ipairs(s:agents("standing")) do
      most = math.max(most, a.pushed)
    end
  end
  truthy(most > 150, "a push of hundreds of newtons")
  truthy(most < 1500, "but not of thousands")
end)

test("without forces the block holds it up for longer", function()
  local function time(forces)
    local s = through { set = { ["forces.enabled"] = forces } }
    while s:agents("runner")[1].x < 1.8 and s:time() < 30 do
      s:step()
    end
    return s:time()
  end
  truthy(time(true) + 0.3 < time(false), "pushing has to help")
end)

test("two runs are the same to the last bit; another crowd is another run", function()
  local a, b = through(), through { threads = 2 }
  local c = through { set = { ["groups.standing.spacing"] = 0.5 } }
  a:run(6)
  b:run(6)
  c:run(6)
  equal(a:hash(), b:hash())
  truthy(a:hash() ~= c:hash(), "the hash tells runs apart")
end)
