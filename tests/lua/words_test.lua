-- Words about others and about oneself: rows, posts, wandering, what others are and remember.
local YARD = { yard = { polygon = { { 0, 0 }, { 20, 0 }, { 20, 20 }, { 0, 20 } } },
  mid = { line = { { 10, 2 }, { 10, 18 } } }, post = { point = { 15, 10 } } }

local function yard(groups, walls)
  return { places = YARD, groups = groups, walls = walls }
end

local WATCH = [[return machine { name = "watch", start = "Look", defaults = { perception = 8 },
  states = { Look = { steer = hold, { to = "Seen", when = sees(nearest "thief") } }, Seen = { steer = hold } } }]]
local WALL = { { 10, 0 }, { 10, 20 } }

test("a wall hides people; a low one, or an open gate, does not", function()
  local function seen(walls)
    local s = scene(yard({ guards = { behaviour = WATCH, at = { { 8, 10 } } },
      thieves = { behaviour = "stander.lua", at = { { 12, 10 } }, tags = { "thief" } } }, walls))
    s:run(0.5)
    return s:count("Seen") == 1
  end
  truthy(seen(nil))
  truthy(not seen { { line = WALL } })
  truthy(seen { { line = WALL, height = 1 } })
  truthy(seen { { line = WALL, name = "gate", open = true } })
end)

test("nobody is touched, heard or counted through a wall", function()
  local LISTEN = [[local other = nearest "crier"
    return machine { name = "listen", start = "Wait", defaults = { perception = 5 }, states = {
      Wait = { steer = hold, { to = "Felt", when = touches(other) | heard "hey" | neighbours("crier"):at_least(1) } },
      Felt = { steer = hold } } }]]
  local CRY = [[return machine { name = "cry", start = "Cry", states = {
      Cry = { steer = hold, signal = { "hey", every = 0.2 } } } }]]
  local function felt(walls)
    local s = scene(yard({ one = { behaviour = LISTEN, at = { { 9.79, 10 } } },
      other = { behaviour = CRY, at = { { 10.21, 10 } }, tags = { "crier" } } }, walls))
    s:run(1)
    return s:count("Felt") == 1
  end
  truthy(felt(nil))
  truthy(not felt { { line = WALL } })
end)

test("people touch by shoulders that are broader than their discs, and by hands as far as those", function()
  local FEEL = [[return machine { name = "feel", start = "Wait", defaults = { depth = 0.25 },
    states = {
      Wait = { steer = hold, { to = "Felt", when = touches(nearest "anyone") } }, Felt = { steer = hold } } }]]
  local function felt(distance, facing, breadth)
    local s = scene(yard { two = { behaviour = FEEL, at = { { 5, 10 }, { 5 + distance, 10 } }, facing = facing,
      set = { breadth = breadth } } })
    s:run(0.2)
    return s:count("Felt")
  end
  equal(felt(0.48, 90, 0.45), 2) -- side by side, 3 cm apart
  equal(felt(0.48, 90, 0.4), 0)
  equal(felt(0.48, 0, 0.45), 0)
  equal(felt(0.44, 0, 0.45), 2) -- one behind the other, the discs 4 cm apart
end)

test("home is where one came in, and is gone back to", function()
  local s = scene(yard { walkers = { at = { { 3, 3 }, { 4, 17 } }, behaviour = [[
    return machine { name = "there_and_back", start = "Out", states = {
      Out = { steer = seek "post", { to = "Back", when = near("post", 1.5) } },
      Back = { steer = seek(home), { to = "Home", when = near(home, 0.3) } },
      Home = { steer = hold } } }]] } })
  s:reaches("Home", { within = 40 })
  s:run(1)
  local agents = s:agents()
  near(agents[1].x, 3, 0.5)
  near(agents[2].y, 17, 0.5)
end)

test("who wanders covers ground, and stays within walls and places", function()
  local WANDER = [[return machine { name = "roam", start = "Roam",
    states = { Roam = { steer = wander(own.where) } }, own = { where = "yard" } }]]
  local s = scene(yard({ roamers = { behaviour = WANDER, count = 12, ["in"] = "yard" } }))
  local before, far = s:agents(), 0
  for _ = 1, 30 do
    s:run(1)
    for n, a in ipairs(s:agents()) do
      truthy(a.x > -1.5 and a.x < 21.5 and a.y > -1.5 and a.y < 21.5, "left the yard")
      far = math.max(far, math.abs(a.x - before[n].x))
    end
  end
  truthy(far > 4, "nobody got anywhere")
end)

test("a row stands along a line, in the order in which its people came", function()
  local s = scene(yard { row = { at = { { 3, 9 }, { 4, 12 }, { 5, 6 }, { 6, 10.5 } }, behaviour = [[
    return machine { name = "row", start = "Row", states = { Row = { steer = formation("mid", 1) } } }]] } })
  s:run(15)
  for _, a in ipairs(s:agents()) do near(a.x, 10, 0.3) end
  near(s:agent(2).y, 8.5, 0.3)
  near(s:agent(0).y, 9.5, 0.3)
  near(s:agent(3).y, 10.5, 0.3)
  near(s:agent(1).y, 11.5, 0.3)
end)

test("a row keeps behind its leader, across the way that one goes", function()
  local s = scene(yard {
    leader = { at = { { 2, 10 } }, tags = { "leader" }, behaviour = [[return machine { name = "lead", start = "Go",
      states = { Go = { steer = drift(0.5, 0) } } }]] },
    row = { at = { { 1, 9 }, { 1, 11 }, { 0.5, 10 } }, behaviour = [[return machine { name = "row", start = "Row",
      defaults = { perception = 8 }, states = { Row = { steer = formation(nearest "leader", 1) } } }]] } })
  s:run(12)
  local lead = s:agent(0)
  for id = 1, 3 do truthy(lead.x - s:agent(id).x > 0.5 and lead.x - s:agent(id).x < 2.5) end
  truthy(s:agent(2).y > s:agent(3).y + 0.5 and s:agent(3).y > s:agent(1).y + 0.5)
end)

test("a drift goes by what one remembers", function()
  local s = scene(yard { people = { at = { { 3, 3 } }, memory = { dx = 0.6, dy = 0.8 }, behaviour = [[
    local mine = memory { dx = 0, dy = 0 }
    return machine { name = "ray", start = "Fly", defaults = { speed = 1 },
      states = { Fly = { steer = drift(mine.dx, mine.dy) } } }]] } })
  s:run(10)
  near(s:agent(0).x - 3, 6, 0.5)
  near(s:agent(0).y - 3, 8, 0.5)
end)

local PLAGUE = [[
  local mine = memory { ill = false, days = 0 }
  return machine { name = "plague", start = "Well", public = { "ill", "days" }, defaults = { perception = 6 },
    states = {
      Well = { steer = hold,
        { to = "Ill", when = heard "bite", set = { ill = true, days = 3 } },
        { to = "Warned", when = neighbours("people"):where("ill"):at_least(1)
            & theirs(nearest("people"):where("ill"), "days"):is(3)
            & sees(nearest("people"):in_state("Ill"):of_group("first"):of_machine("plague"))
            & ~sees(nearest("people"):of_group("second"):in_state("Ill"))
            & neighbours("people"):where("days", 2, 4):is(1) & neighbours("people"):where("days", 4):is(0) } },
      Ill = { steer = hold }, Warned = { steer = hold } } }]]

test("others are told apart by state, machine, group and what they make public", function()
  local s = scene(yard {
    first = { at = { { 10, 10 } }, behaviour = PLAGUE, tags = { "people" } },
    second = { at = { { 12, 10 }, { 14, 10 } }, behaviour = PLAGUE, tags = { "people" } },
    biter = { at = { { 5, 10 } }, behaviour = [[return machine { name = "bite", start = "Bite",
      states = { Bite = { steer = hold, signal = "bite" } } }]] } })
  s:run(2)
  equal(s:agents("first")[1].state, "Ill")
  equal(s:count("Warned", { agents = "second" }), 2)
end)

test("own values have defaults and distributions in the behaviour, and groups may set them", function()
  local BRAVE = [[return machine { name = "brave", start = "Look", own = { courage = uniform(0, 1), camp = "post" },
    states = { Look = { steer = hold,
      { to = "Brave", when = (0 + own.courage):at_least(0.5) },
      { to = "Shy" } }, Brave = { steer = seek(own.camp) }, Shy = { steer = hold } } }]]
  local s = scene(yard { any = { behaviour = BRAVE, count = 60, ["in"] = "yard" },
    lions = { behaviour = BRAVE, at = { { 1, 1 }, { 1, 3 } }, set = { courage = 1 } } })
  s:run(0.2)
  equal(s:count("Brave", { agents = "lions" }), 2)
  truthy(s:count("Brave", { agents = "any" }) > 15 and s:count("Shy", { agents = "any" }) > 15)
end)

test("team and tags are changed by set", function()
  local s = scene(yard {
    turncoats = { at = { { 10, 10 } }, team = "red", tags = { "red" }, behaviour = [[
      return machine { name = "turncoat", start = "Red", states = {
        Red = { steer = hold, { to = "Blue", when = after(0.5), set = { team = "blue", tags = "blue" } } },
        Blue = { steer = hold } } }]] },
    reds = { at = { { 12, 10 } }, team = "red", tags = { "red" }, behaviour = [[
      return machine { name = "red", start = "Calm", states = {
        Calm = { steer = hold, { to = "Alone", when = ~sees(nearest "teammates") & sees(nearest "opponents")
          & neighbours("blue"):is(1) & neighbours("red"):is(0) } }, Alone = { steer = hold } } }]] },
    blues = { at = { { 1, 1 } }, team = "blue", tags = { "blue" }, behaviour = "stander.lua" } })
  s:run(0.3)
  equal(s:count("Alone"), 0)
  s:run(0.6)
  equal(s:count("Alone"), 1)
end)

test("what cannot be is refused, with the place and a way out", function()
  local function wrong(text, says)
    refused(yard { people = { at = { { 1, 1 } }, behaviour = "local mine = memory { n = 0 }\n" .. text } }, says)
  end
  local M = 'return machine { name = "m", start = "A", '
  wrong(M .. 'own = { speed = 1 }, states = { A = {} } }', "defaults")
  wrong(M .. 'own = { x = now.speed }, states = { A = {} } }', "drawn once")
  wrong(M .. 'public = { "m" }, states = { A = {} } }', "no 'm' to make public")
  wrong(M .. 'states = { A = { steer = wander } } }', "with parentheses")
  wrong(M .. 'states = { A = { ignore = "green" } } }', "bears the tag 'green', and no state sets it")
  wrong(M .. 'states = { A = { steer = seek(nearest("anyone"):of_group("people_")) } } }', "no group 'people_'")
  wrong(M .. 'states = { A = { steer = seek(home:in_state("A")) } } }', "nothing of a target")
  wrong(M .. 'states = { A = { steer = drift(400, 0) } } }', "from -100 to 100")
end)

test("a target that comes is dodged to the nearer side, or to the other one where a wall is", function()
  local DODGER = [[return machine { name = "dodger", start = "Go", defaults = { perception = 20 }, states = {
    Go = { steer = dodge(nearest "ball"), ignore = "ball" } } }]]
  -- Where an agent at x = 10 stands, of y = 10 at first, once a ball that comes along `line` has passed.
  local function stands_after(line, speed, walls)
    local game = yard({ one = { behaviour = DODGER, at = { { 10, 10 } } } }, walls)
    game.bodies = { { tags = { "ball" }, shape = { sphere = { radius = 0.11 } }, mass = 0.4, at = { 4, line, 2.5 },
      velocity = { speed, 0, 6 } } }
    local s = scene(game)
    s:run(1.5)
    return s:agents("one")[1].y
  end
  near(stands_after(9.7, 6), 10.7, 0.15)  -- out of the line by 1 m
  near(stands_after(10.3, 6), 9.3, 0.15)
  truthy(stands_after(10, 6) < 9.3)       -- right of its motion, if straight ahead
  near(stands_after(8.9, 6), 10, 0.02)    -- it passes clear
  near(stands_after(9.7, -6), 10, 0.02)   -- it goes away
  local WALL_ABOVE = { { line = { { 8, 10.5 }, { 12, 10.5 } } } }
  near(stands_after(9.8, 6, WALL_ABOVE), 8.8, 0.15)
end)

test("who stays in a place stops before its edges, however it is steered, and comes back into it", function()
  local function run(key, at, steer)
    local behaviour = "return machine { name = \"w\", start = \"Go\", defaults = { speed = 3, max_speed = 3 },"
      .. "states = { Go = { steer = " .. steer .. key .. " } } }"
    local s = scene(yard { people = { behaviour = behaviour, at = { at } } })
    local farthest = { -1, -1 }
    for _ = 1, 200 do
      s:step()
      local a = s:agents()[1]
      if s:time() > 5 then farthest = { math.max(farthest[1], a.x), math.max(farthest[2], a.y) } end
    end
    return farthest[1], farthest[2]
  end
  local KEY = ", stays_in = \"yard\""
  for _, steer in ipairs { "drift(1, 0.7)", "function(me) return 3, 2 end" } do -- into the corner at 20, 20
    local x, y = run(KEY, { 3, 10 }, steer)
    truthy(x > 19.6 and x < 19.9 and y > 19.6 and y < 19.9, "it stands at " .. x .. ", " .. y)
    x = run("", { 3, 10 }, steer)
    truthy(x > 25, "without it it goes on")
  end
  local x, y = run(KEY, { 26, 12 }, "hold")
  truthy(x > 19 and x < 19.9, "it comes back to " .. x)
  near(y, 12, 0.1)
  local LINE = "return machine { name = \"w\", start = \"A\", states = { A = { steer = hold, stays_in = \"mid\" } } }"
  refused(yard { a = { behaviour = LINE, at = { { 1, 1 } } } }, "needs a place with an area")
end)
