-- throng.lua: stops before what is in the way, waits, then presses on it.
local function lane(body, count)
  return {
    places = {
      start = { polygon = { { 0, -1.8 }, { 4, -1.8 }, { 4, 1.8 }, { 0, 1.8 } } },
      goal = { point = { 16, 0 }, radius = 1.5 },
    },
    walls = { { line = { { -2, -2 }, { 18, -2 }, { 18, 2 }, { -2, 2 } }, closed = true } },
    bodies = { body },
    groups = {
      people = { behaviour = "throng.lua", count = count, ["in"] = "start", spacing = 0.5, set = { goal = "goal" } },
    },
  }
end

local function block(mass)
  local shape = { box = { size = { 1, 3.8, 1.3 } } }
  return { name = "block", shape = shape, mass = mass, friction = 0.2, at = { 8, 0, 0.65 } }
end

local function glued(bond)
  return {
    name = "block",
    shape = { blocks = { size = { 0.5, 0.39, 0.26 }, count = { 2, 10, 5 }, bond = bond } },
    mass = 150,
    friction = 0.2,
    at = { 8, 0, 0.65 },
  }
end

test("one stops before what it cannot pass, waits, and then presses", function()
  local alone = lane(block(20000), 1)
  alone.groups.people = { behaviour = "throng.lua", at = { { 2, 0.5 } }, set = { goal = "goal" } }
  local s = scene(alone)
  s:run(3) -- it stands at the start, too
  s:reaches("Wait", { within = 9 })
  s:never("Press", { during = 6 })
  truthy(s:agent(0).x < 7.5 - s:agent(0).radius, "it has not touched the block")
  s:reaches("Press", { within = 7 })
  s:run(4)
  near(s:agent(0).x, 7.5 - s:agent(0).radius, 0.1)
  near(s:body("block").x, 8, 0.02)
end)

test("together they push a light block along, and all come to the goal's side", function()
  local s = scene(lane(block(60), 12), { seed = 2 })
  s:run(60)
  truthy(s:body("block").x > 9, "the block has been pushed along")
end)

test("glue that bears them holds; weak glue gives way, and they walk through", function()
  local holds, breaks = scene(lane(glued(1e6), 12)), scene(lane(glued(5), 12))
  holds:run(40)
  breaks:run(60)
  equal(holds:count(), 12)
  truthy(breaks:count() < 12, "who is through the pieces is gone")
end)

test("two runs are the same to the last bit, on one thread and on two", function()
  local a, b = scene(lane(glued(5), 12)), scene(lane(glued(5), 12), { threads = 2 })
  a:run(20)
  b:run(20)
  equal(a:hash(), b:hash())
end)
