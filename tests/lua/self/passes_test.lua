-- Every test here must pass: what tests can see and do.
local function walking()
  return {
    places = { goal = { point = { 5, 0 } } },
    bodies = {
      { name = "ball", shape = { sphere = { radius = 0.2 } }, mass = 1, at = { 40, 0, 5 }, velocity = { 1, 0, 0 } },
    },
    groups = {
      late = { behaviour = "walker.lua", at = { { -20, 3 }, { -21, 3 } }, set = { goal = "goal", speed = 1 } },
      soon = { behaviour = "walker.lua", at = { { 2, 0 } }, set = { goal = "goal", speed = 1 } },
    },
  }
end

test("time goes by in steps", function()
  local s = scene(walking())
  equal(s:time(), 0)
  s:step()
  near(s:time(), 0.05, 1e-9)
  s:step(3)
  near(s:time(), 0.2, 1e-9)
  s:run(1)
  near(s:time(), 1.2, 1e-9)
  s:run(0)
  s:run(-1)
  s:step(0)
  near(s:time(), 1.2, 1e-9)
end)

test("agents are counted by state and by group, and those that left are remembered", function()
  local s = scene(walking())
  equal(s:count(), 3)
  equal(s:count("Walk"), 3)
  equal(s:count("Walk", { agents = "late" }), 2)
  equal(s:entered("Gone"), 0)
  s:reaches("Gone", { agents = "soon", within = 5 })
  equal(s:count(), 2)
  equal(s:count("Gone"), 0)
  equal(s:entered("Gone"), 1)
  equal(s:entered("Gone", { agents = "late" }), 0)
  equal(s:entered("Walk"), 3)
end)

test("reaches gives the time; any and count are enough where they are asked for", function()
  local s = scene(walking())
  local first = s:reaches("Gone", { any = true, within = 10 })
  equal(first, s:time())
  near(first, 2.5, 1)
  truthy(s:reaches("Gone", { count = 2, within = 40 }) > 20)
  truthy(s:reaches("Gone", { within = 5 }) > 20)
end)

test("agents are seen in order of id, as copies", function()
  local s = scene(walking())
  s:step()
  local all = s:agents()
  equal(#all, 3)
  for n, a in ipairs(all) do
    equal(a.id, n - 1)
    equal(a.machine, "walker")
    equal(a.state, "Walk")
  end
  equal(#s:agents("late"), 2)
  near(s:agents("soon")[1].x, 2, 0.1)
  near(s:agents("soon")[1].speed, 1, 1e-6)
  equal(s:agent(99), nil)
  equal(s:agent(-1), nil)
  local hash = s:hash()
  s:agent(0).x = 1000
  truthy(s:agent(0).x < 0, "writing to a copy changes nothing")
  equal(s:hash(), hash)
end)

test("groups give placed agents teams, own values and memory, which are seen", function()
  local behaviour = [[local mine = memory { coins = 0 }
    return machine { name = "shopper", version = 1, start = "Stand", own = { shoe = 40, rest = uniform(1, 2) },
      states = {
        Stand = { steer = hold, speed = own.shoe / 40, { to = "Join", when = near(own.room, 3) & after(1) } },
        Join = { steer = hold, set = { team = "visitors" } } } }]]
  local s = scene { places = { shop = { point = { 0, 0 } }, yard = { point = { 9, 0 } } }, groups = {
    home = { behaviour = behaviour, at = { { 0, 0 } }, team = "red",
      set = { shoe = 44, room = "shop" }, memory = { coins = 7 } },
    away = { behaviour = behaviour, at = { { 4, 0 } }, team = "blue", set = { room = "yard" } },
    none = { behaviour = behaviour, at = { { 8, 4 } }, set = { room = "shop" } } } }
  s:step()
  local a, b, c = s:agents("home")[1], s:agents("away")[1], s:agents("none")[1]
  equal(a.group, "home") equal(a.team, "red") equal(a.own.shoe, 44) equal(a.own.room, "shop") equal(a.coins, 7)
  near(a.speed, 1.1, 1e-6)
  equal(b.group, "away") equal(b.team, "blue") equal(b.own.shoe, 40) equal(b.own.room, "yard")
  truthy(b.own.rest >= 1 and b.own.rest <= 2)
  equal(c.team, nil)
  fails(function() return a.coin end, "an agent has no 'coin'; did you mean coins")
  s:run(1.5)
  equal(s:agent(a.id).state, "Join") equal(s:agent(a.id).team, "visitors") equal(s:agent(b.id).team, "blue")
end)

test("bodies are seen", function()
  local s = scene(walking())
  s:run(0.5)
  local ball = s:body("ball")
  near(ball.vx, 1, 0.01)
  near(ball.x, 40.5, 0.06)
  truthy(ball.vz < -4, "it falls")
  truthy(ball.z < 5)
end)

test("a scene's file with other values, a seed and a step", function()
  local s = scene("circle.yaml", { set = { ["groups.crossing.count"] = 10 }, dt = 0.02 })
  equal(s:count(), 10)
  s:step()
  near(s:time(), 0.02, 1e-9)
end)

test("the hash tells what was done, not who looked", function()
  local other = walking()
  other.groups.soon.set.speed = 1.1
  local a, b, c = scene(walking()), scene(walking()), scene(other)
  a:run(2)
  for _ = 1, 40 do
    b:step()
    b:agents()
    b:count("Walk")
    b:hash()
  end
  c:run(2)
  equal(a:hash(), b:hash())
  truthy(a:hash() ~= c:hash())
  equal(#a:hash(), 16)
end)

test("the seed of a scene is 1 unless given", function()
  local drawn = walking()
  drawn.groups.late.set.speed = "uniform(0.5, 2)"
  local a, b, c = scene(drawn), scene(drawn, { seed = 1 }), scene(drawn, { seed = 2 })
  a:run(2)
  b:run(2)
  c:run(2)
  equal(a:hash(), b:hash())
  truthy(a:hash() ~= c:hash())
end)

test("never and slower_than hold where they should", function()
  local s = scene(walking())
  s:never("Gone", { agents = "late", during = 5 })
  s:slower_than(1.2, { agents = "late", during = 2 })
  near(s:faster_than(0.8, { agents = "late", during = 2 }), 1, 0.1)
end)

test("a behaviour that stands in the test", function()
  local s = scene {
    groups = {
      people = {
        at = { { 0, 0 }, { 3, 0 } },
        behaviour = [[
return machine {
  name = "inline", version = 1, start = "First",
  states = { First = { steer = hold, { to = "Second", when = after(1) } }, Second = { steer = hold } },
}]],
      },
    },
  }
  s:never("Second", { during = 0.9 })
  s:reaches("Second", { within = 0.3 })
  equal(s:agent(0).machine, "inline")
end)

test("errors are caught by those who expect them", function()
  fails(function() error("apples and pears") end, "pears")
  fails(function() equal(1, 2) end, "1 is not 2")
  refused({ groups = { people = { behaviour = "nobody.lua", at = { { 0, 0 } } } } }, "nobody.lua")
end)
