-- tawaf.lua, on a small Tawaf: a Kaaba of 6 m and a yard of 28 m.
local SIDES = { { 3, -3 }, { 3, 3 }, { -3, 3 }, { -3, -3 } }

local function tawaf(count, laps, options, touched)
  return scene({
    places = {
      start_line = { line = { { 3, -3 }, { 30, -3 } } },
      kaaba = { polygon = SIDES, start = "start_line" },
      yard = { polygon = { { 14, -14 }, { 14, 14 }, { -14, 14 }, { -14, -14 } } },
      black_stone = { queue = { { 3.3, -3.3 }, { 3, -3.5 }, { -3, -4 } }, spacing = 0.5 },
      east = { point = { 25, 20 }, radius = 2 },
      west = { point = { -25, 20 }, radius = 2 },
      gates = { set = { "east", "west" } },
    },
    walls = { { solid = SIDES } },
    groups = {
      pilgrims = {
        behaviour = "tawaf.lua", count = count, fill = "random", ["in"] = "yard", outside = { "kaaba" },
        memory = { laps = laps, touched = touched or false },
      },
    },
  }, options)
end

test("seven circuits, then out by a gate, and everybody gets there", function()
  local s = tawaf(60, 0)
  s:never("Exit", { during = 120 }) -- seven circuits of at least 24 m take longer at any speed that is drawn
  s:never("Gone")
  s:reaches("Exit", { within = 700 }) -- the last circuit is a wide one
  s:reaches("Gone", { within = 120 })
  equal(s:count(), 0)
  truthy(s:entered("Istilam") >= 40, "seven times a chance of 0.3")
  truthy(s:entered("Touch") >= 1, "somebody gets to the stone")
  truthy(s:entered("Touch") <= s:entered("Queue"), "and nobody past the queue")
end)

test("people leave by all gates, whichever is nearer", function()
  local s, last, left = tawaf(60, 6), {}, { east = 0, west = 0 }
  while s:count() > 0 do
    s:step()
    local there = {}
    for _, a in ipairs(s:agents()) do
      there[a.id] = a
    end
    for id, a in pairs(last) do
      if not there[id] then
        local gate = a.x > 0 and "east" or "west"
        left[gate] = left[gate] + 1
      end
    end
    last = there
  end
  equal(left.east + left.west, 60)
  truthy(left.east > 15 and left.west > 15, "about as many by each")
end)

test("circuits go anti-clockwise and are counted one by one", function()
  local s, before = tawaf(30, 0), {}
  local forwards, backwards = 0, 0
  for _ = 1, 80 do
    s:run(1)
    for _, a in ipairs(s:agents()) do
      local last = before[a.id]
      if last then
        truthy(a.laps - last <= 1, "at most one circuit in a second")
      end
      before[a.id] = a.laps
      local turn = a.x * a.vy - a.y * a.vx
      forwards, backwards = forwards + (turn > 0 and 1 or 0), backwards + (turn < 0 and 1 or 0)
    end
  end
  truthy(forwards > 5 * backwards, "nearly all walk anti-clockwise")
  local most = 0
  for _, laps in pairs(before) do
    most = math.max(most, laps)
  end
  truthy(most >= 1, "80 s are enough for the fastest")
  truthy(most <= 4, "and not for five")
end)

test("nobody leaves with fewer than seven, and nobody goes on", function()
  local s, leaves = tawaf(40, 5), {}
  repeat
    s:step()
    for _, a in ipairs(s:agents()) do
      truthy(leaves[a.id] or a.state ~= "Exit" or a.laps == 7, "seven, when it turns to a gate")
      leaves[a.id] = a.state == "Exit"
    end
  until s:count() < 20
  truthy(s:time() > 30, "two circuits take time")
end)

test("the stone: by the queue, for three seconds, once", function()
  local s, state, since, touches = tawaf(60, 0), {}, {}, {}
  local visits = 0
  local busy = 0
  for _ = 1, 4800 do
    s:step()
    local before = busy
    busy = s:count("Queue") + s:count("Touch")
    for _, a in ipairs(busy + before > 0 and s:agents() or {}) do
      local from = state[a.id]
      if from ~= a.state then
        if a.state == "Touch" then
          equal(from, "Queue")
          equal(a.touched, false)
          touches[a.id] = (touches[a.id] or 0) + 1
          equal(touches[a.id], 1)
        elseif from == "Touch" then
          equal(a.state, "Circle")
          equal(a.touched, true)
          near(s:time() - since[a.id], 3, 0.11)
          visits = visits + 1
        end
        state[a.id], since[a.id] = a.state, s:time()
      end
    end
  end
  truthy(visits >= 3, "several people get there in four minutes")
end)

test("who has touched the stone does not queue for it again", function()
  local fresh, done = tawaf(60, 0), tawaf(60, 0, nil, true)
  done:never("ToStone", { during = 230 })
  fresh:run(230)
  truthy(fresh:entered("ToStone") >= 3, "of those who have not, some do")
end)

test("who greets the stone goes slowly, and not for long", function()
  local s, since, seen, fast = tawaf(40, 0), {}, 0, 0
  for _ = 1, 1600 do
    s:step()
    for _, a in ipairs(s:agents()) do
      if a.state == "Istilam" then
        since[a.id] = since[a.id] or s:time()
        truthy(s:time() - since[a.id] < 14, "10 s at most")
        if s:time() - since[a.id] > 1.5 then
          seen = seen + 1
          fast = fast + (a.now < 0.5 and 0 or 1)
        end
      else
        since[a.id] = nil
      end
    end
  end
  truthy(seen > 100)
  truthy(fast < 0.1 * seen, "slower than 0.46 m/s, but for pushes")
end)

test("people walk at the speeds of people", function()
  local s = tawaf(60, 0)
  s:run(5)
  s:slower_than(2.1, { during = 20 })
  truthy(s:faster_than(0.4, { during = 5 }) < 1.2)
end)

test("the same to the last bit again and on two threads; another seed is another run", function()
  local a, b, c = tawaf(60, 0), tawaf(60, 0, { threads = 2 }), tawaf(60, 0, { seed = 2 })
  a:run(40)
  b:run(40)
  c:run(40)
  equal(a:hash(), b:hash())
  truthy(a:hash() ~= c:hash(), "the seed matters")
end)

test("the shipped scene runs with few pilgrims, and a source keeps their number", function()
  local few = { ["groups.pilgrims.count"] = 300, ["sources.0.keep"] = 300, ["groups.pilgrims.memory.laps"] = 6 }
  local s = scene("tawaf.yaml", { set = few })
  s:run(30)
  equal(s:count(), 300)
  truthy(s:entered("Circle") > 5, "people cross the line")
  s:slower_than(2.1, { during = 2 })
end)

test("who has not finished passes a gate by", function()
  local s = scene("tawaf.yaml", { set = {
    ["groups.pilgrims.count"] = 1500, ["sources.0.keep"] = 1, ["groups.pilgrims.memory.laps"] = 0,
    ["places.gate_1.point.0"] = 20, ["places.gate_1.point.1"] = 20,
  } })
  local passing = 0
  for _ = 1, 30 do
    s:run(1)
    for _, a in ipairs(s:agents()) do
      passing = passing + ((a.x - 20) ^ 2 + (a.y - 20) ^ 2 < 64 and 1 or 0)
    end
  end
  truthy(passing > 30, "there are people in the gate")
  equal(s:count(), 1500)
end)

test("without a Black Stone the machine is refused", function()
  refused({
    places = {
      start_line = { line = { { 3, -3 }, { 30, -3 } } },
      kaaba = { polygon = SIDES, start = "start_line" },
      gates = { point = { 9, 9 } },
    },
    groups = { pilgrims = { behaviour = "tawaf.lua", at = { { 5, 5 } } } },
  }, "black_stone")
end)
