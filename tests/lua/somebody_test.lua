-- Functions see whom the words see: somebody in memory, who holds, who threw, messages; and what leaves or is hidden.
local HUNTER = [[
  local mine = memory { prey = nobody, spot = nobody, away = 0, gone = false, hidden = false, thing = nobody,
    heard = 0 }
  return machine { name = "hunter", start = "Look", defaults = { perception = 20 }, states = {
    Look = { steer = hold, { to = "Hold", when = sees(nearest "prey"), set = { prey = nearest "prey" } } },
    Hold = { steer = hold,
      on_enter = function(me)
        me.away, me.spot, me.thing = me.prey.x - me.x, "post", me.prey
        me.tell(me.prey, "look", { at = me.prey, number = 3, yes = true })
      end,
      { every = 0.1, on_take = function(me)
          me.gone = me.prey == nil
          me.hidden = me.prey ~= nil and not me.prey.in_sight
          local answer = me.told "seen"
          if answer then me.heard = me.heard + answer.number; me.thing = answer.sender end
        end } } } }]]
local PREY = [[
  local mine = memory { told_by = nobody, number = 0, me_too = false }
  return machine { name = "prey", start = "Wait", states = {
    Wait = { steer = hold, { to = "Answer", when = after(0.3) } },
    Answer = { steer = hold,
      { when = function(me)
          local look = me.told "look"
          if look then
            me.told_by, me.number = look.sender, look.number
            me.me_too = look.at.id == me.id
            me.tell(look.sender, "seen", { number = look.number + 1 })
          end
          return false
        end, set = { number = 0 } },
      { to = "Gone", when = after(1) } },
    Gone = { removes = true } } }]]

local function pair(walls)
  return scene { places = { post = { point = { 5, 5 } } }, walls = walls, groups = {
    hunter = { behaviour = HUNTER, at = { { 0, 0 } } },
    prey = { behaviour = PREY, at = { { 6, 0 } }, tags = { "prey" } } } }
end

test("functions hold somebody, tell them and are told; who left is nil", function()
  local s = pair()
  s:run(0.8)
  local hunter, prey = s:agents("hunter")[1], s:agents("prey")[1]
  equal(hunter.away, 6)
  equal(hunter.prey, prey.id)
  equal(hunter.spot, "place 'post'")
  equal(hunter.gone, false)
  equal(hunter.heard, 4)
  equal(prey.told_by, hunter.id)
  equal(prey.number, 3)
  truthy(prey.me_too)
  s:run(2)
  hunter = s:agents("hunter")[1]
  equal(#s:agents("prey"), 0)
  truthy(hunter.gone)
  equal(hunter.prey, nil)
end)

test("whom a wall hides is held, and not seen", function()
  local s = scene { walls = { { line = { { 3, -9 }, { 3, 9 } }, name = "gate", open = true } },
    places = { post = { point = { 5, 5 } } }, events = { { at = 0.2, close = "gate" } }, groups = {
    hunter = { behaviour = HUNTER, at = { { 0, 0 } } },
    prey = { behaviour = PREY, at = { { 6, 0 } }, tags = { "prey" } } } }
  s:run(1)
  local hunter = s:agents("hunter")[1]
  truthy(hunter.hidden)
  equal(hunter.gone, false)
end)

-- What goes wrong in functions is said with the way out.
local function fails_with(body, text)
  local machine = [[local mine = memory { prey = nobody, n = 0 }
    return machine { name = "m", start = "A", states = { A = { steer = hold, on_enter = function(me) ]] .. body ..
    [[ end, { to = "B", when = after(0.2) } }, B = { steer = hold } } }]]
  local s = scene { groups = { one = { behaviour = machine, at = { { 0, 0 } } } } }
  fails(function() s:run(0.3) end, text)
end

test("mistakes in functions name the way out", function()
  fails_with('me.prey = 3', "prey is somebody: me, a neighbour, the name of a place of the scene, or nil")
  fails_with('me.prey = now', "prey is somebody")
  fails_with('me.tell(nil, "a", { sender = 1 })', "`sender` is who told the message")
  fails_with('me.tell(nil, "a", { a = 1, b = 1, c = 1, d = 1, e = 1 })', "at most 4 values")
  fails_with('me.tell(me.prey, 7)', "a message has a name")
  fails_with('me.tell(me.prey, "a", 7)', "{ damage = 2 }")
end)

test("mistakes in the table name the place and the way out", function()
  local function wrong(items, says)
    refused({ places = { post = { point = { 5, 5 } } }, groups = { one = { at = { { 1, 1 } }, behaviour =
      'local mine = memory { prey = nobody, n = 0, met = list(4, nobody), times = list(2) }\n' ..
      'return machine { name = "m", start = "A", states = { A = { ' ..
      items .. ' } } }' } } }, says)
  end
  wrong('steer = seek(other)', "the candidate in the score of `best`")
  wrong('steer = seek(best("anyone", distance(best("anyone", now.x))))', "cannot stand in the score of another one")
  wrong('set = { prey = 3 }', "must be a target")
  wrong('set = { prey = home }', "holds somebody, and a point is not")
  wrong('steer = seek(last_seen(nearest "anyone"))', "takes memory that holds somebody")
  wrong('set = { n = mine.prey.laps }', 'theirs(target, "laps")')
  wrong('set = { n = mine.prey.sped }', "Did you mean 'speed'")
  wrong('steer = seek(nearest("anyone"):within(0))', "from 0.01 to 1000 m")
  wrong('steer = seek(nearest("anyone"):ahead(200))', "from 1 to 179")
  wrong('steer = seek(home:within(3))', "nothing of a target")
  wrong('tell = "shot"', "tell must be a table")
  wrong('tell = { "post", "shot" }', "tell needs whom it tells")
  wrong('tell = { nearest "anyone" }', "the name of the message as its second item")
  wrong('tell = { mine.prey, "shot", a = 1, b = 2, c = 3, d = 4, e = 5 }', "at most 4 values")
  wrong('tell = { mine.prey, "shot", sender = 3 }', "`sender` is who told the message")
  wrong('tell = { mine.prey, "shot", a = seek(home) }', "must be a number")
  wrong('tell = { mine.prey, "shot", a = mine.met }', "a message carries numbers, conditions and targets, not a list")
  wrong('{ when = after(1) }', "an item needs `to`")
  wrong('{ every = 0, set = { n = 1 } }', "from 0.01 to 1e+06 s")
  wrong('{ every = 1, when = function(me) return true end, set = { n = 1 } }', "not with a function")
  wrong('set = { met = mine.prey }', "is a list, which is set by its own :push")
  wrong('set = { met = mine.times:push(1) }', "is a list, which is set by its own :push")
  wrong('set = { times = mine.times:push(nearest "anyone") }', "holds numbers")
  wrong('set = { met = mine.met:push(3) }', "argument 2 of push")
  wrong('set = { n = mine.met.length }', "a list has no 'length'")
  wrong('set = { n = mine.met }', "must be a number")
  wrong('steer = seek(mine.met)', "argument 1 of seek")
  wrong('} }, public = "met", own = { a = { ', "public memory is a number")
  wrong('{ when = same(mine.prey), set = { n = 1 } }', "argument 2 of same")
end)

test("best is the greatest score, of equal ones the lowest id, and bodies after agents", function()
  local best = [[local mine = memory { far = nobody, equal = nobody, both = nobody, near = nobody }
    return machine { name = "chooser", start = "A", defaults = { perception = 30 }, states = {
      A = { steer = hold, { to = "B", when = after(0.1), set = {
        far = best("things", distance(other)), equal = best("things", 0 * other.x),
        near = best("things", 0 - distance(other)), both = best("things", other.y) } } },
      B = { steer = hold, set = { far = mine.far } } } }]]
  local still = [[return machine { name = "still", start = "A", states = { A = { steer = hold } } }]]
  local s = scene {
    bodies = { { shape = { sphere = { radius = 0.2 } }, mass = 1, at = { 0, 9, 0.2 }, tags = { "things" },
      name = "ball" } },
    groups = { chooser = { behaviour = best, at = { { 0, 0 } } },
      others = { behaviour = still, at = { { 3, 0 }, { -5, 0 }, { 4, 1 } }, tags = { "things" } },
      last = { behaviour = still, at = { { 9, -9 } }, tags = { "nothing" } } } }
  s:run(0.3)
  local a, others = s:agents("chooser")[1], s:agents("others")
  equal(a.far, "body 'ball'")
  equal(a.equal, others[1].id)
  equal(a.near, others[1].id)
  equal(a.both, "body 'ball'")
end)

-- One who listens late, when eighteen messages have come.
local DEAF = [[return machine { name = "deaf", start = "Wait", states = {
  Wait = { steer = hold, { to = "Hear", when = after(2) } },
  Hear = { steer = hold, { when = told "call", set = { n = mine.n + 1, last = told("call").number } } } } }]]
test("messages wait in order, and of more than 16 the oldest goes", function()
  local s = scene { groups = {
    deaf = { behaviour = "local mine = memory { n = 0, last = 0 }\n" .. DEAF, at = { { 0, 0 } }, tags = { "deaf" } },
    caller = { at = { { 3, 0 } }, behaviour = [[local mine = memory { k = 0 }
      return machine { name = "caller", start = "Call", defaults = { perception = 9 }, states = { Call = { steer = hold,
        { every = 0.1, when = mine.k:below(18), set = { k = mine.k + 1 },
          tell = { nearest "deaf", "call", number = mine.k + 1 } } } } }]] } } }
  s:run(2.1)
  equal(s:agents("deaf")[1].last, 3) -- 1 and 2 went
  s:run(1)
  local deaf = s:agents("deaf")[1]
  equal(deaf.n, 16)
  equal(deaf.last, 18)
end)

test("all items of a step that hold rest on the same message, which is used up by them", function()
  local asker = [[return machine { name = "asker", start = "A", defaults = { perception = 9 }, states = {
    A = { steer = hold, { to = "B", when = after(0.5), tell = { nearest "servers", "ask", number = 1 } } },
    B = { steer = hold, { to = "C", when = after(0.1), tell = { nearest "servers", "ask", number = 2 } } },
    C = { steer = hold } } }]]
  local server = [[local mine = memory {
      busy = false, first = 0, second = 0, third = 0, entered = 0, taken = 0, left = 0 }
    local ask = told "ask"
    return machine { name = "server", start = "Open", defaults = { perception = 9 }, states = {
      Open = { steer = hold,
        { when = ask & ~mine.busy, set = { busy = true, first = mine.first + ask.number } },
        { when = ask, set = { second = mine.second + ask.number }, on_take = function(me)
            me.taken = me.taken + me.told("ask").number
            me.left = me.told "ask" and 1 or 0
          end },
        { when = ask & ~mine.busy, set = { third = mine.third + ask.number } },
        { to = "Shut", when = ask } },
      Shut = { steer = hold, set = { entered = ask.number }, { to = "Last", when = ask & after(1) } },
      Last = { steer = hold, set = { busy = false, entered = 10 * mine.entered + ask.number } } } }]]
  local s = scene { groups = { asker = { behaviour = asker, at = { { 0, 0 } } },
    server = { behaviour = server, at = { { 2, 0 } }, tags = { "servers" } } } }
  s:run(0.56)
  s:run(0.06)
  local one = s:agents("server")[1]
  equal(one.state, "Shut")
  equal(one.first, 1)
  equal(one.second, 1)
  equal(one.third, 1)
  equal(one.taken, 1)
  equal(one.left, 0)
  equal(one.entered, 1)
  s:run(2)
  one = s:agents("server")[1]
  equal(one.state, "Last") -- by the second message
  equal(one.entered, 12)
end)

test("who has left the world is in no list any more, and makes room there", function()
  local one = [[local mine = memory { met = list(3, nobody), size = 0, first = nobody, hooks = 0 }
    local met = mine.met
    return machine { name = "one", start = "A", defaults = { perception = 20 }, states = {
      A = { steer = hold, { to = "B", when = after(0.1), set = { met = met:push(nearest "early") } } },
      B = { steer = hold, { to = "C", when = after(0.1), set = { met = met:push(nearest "late") } } },
      C = { steer = hold, { to = "D", when = after(0.1), set = { met = met:push(nearest "ball") } } },
      D = { steer = hold, { to = "E", when = after(1), set = { size = met.size, first = met.first } } },
      E = { steer = hold, on_enter = function(me) me.hooks = #me.met end,
        { to = "F", when = after(0.1), set = { met = met:push("post") } } },
      F = { steer = hold } } }]]
  local leaver = [[return machine { name = "leaver", start = "A", states = {
    A = { steer = hold, { to = "B", when = after(0.6) } }, B = { removes = true } } }]]
  local still = [[return machine { name = "still", start = "A", states = { A = { steer = hold } } }]]
  local s = scene { places = { post = { point = { 9, 9 } } },
    bodies = { { shape = { sphere = { radius = 0.2 } }, mass = 1, at = { 0, 9, 0.2 }, tags = { "ball" }, name = "b" } },
    groups = { one = { behaviour = one, at = { { 0, 0 } } },
      leaver = { behaviour = leaver, at = { { 3, 0 } }, tags = { "early" } },
      still = { behaviour = still, at = { { 5, 0 } }, tags = { "late" } } } }
  s:run(0.5)
  equal(#s:agents("one")[1].met, 3)
  s:run(2)
  local a, late = s:agents("one")[1], s:agents("still")[1].id
  equal(a.size, 2)
  equal(a.first, late)
  equal(a.hooks, 2)
  equal(#a.met, 3) -- nobody who is there had to go
  equal(a.met[1], late)
  equal(a.met[3], "place 'post'")
end)

test("left counts who went from a place, wherever the agent is", function()
  local leaver = [[return machine { name = "leaver", start = "Go", states = {
    Go = { steer = seek(own.way), { to = "Gone", when = inside(own.way) } }, Gone = { removes = true } } }]]
  local guard = [[local mine = memory { both = 0 }
    return machine { name = "guard", start = "Wait", defaults = { perception = 1 }, states = {
      Wait = { steer = hold,
        { to = "Done", when = left("east"):at_least(2) & left("west"):is(1), set = { both = left "ways" } } },
      Done = { steer = hold } } }]]
  local s = scene {
    places = { east = { polygon = { { 5, -2 }, { 8, -2 }, { 8, 2 }, { 5, 2 } } },
      west = { polygon = { { -8, -2 }, { -5, -2 }, { -5, 2 }, { -8, 2 } } }, ways = { set = { "east", "west" } } },
    groups = { guard = { behaviour = guard, at = { { 0, 20 } } },
      east = { behaviour = leaver, at = { { 2, 0 }, { 2, 1 } }, set = { way = "east" } },
      west = { behaviour = leaver, at = { { 0, -1 } }, set = { way = "west" } } } }
  s:reaches("Done", { agents = "guard", within = 12 })
  equal(s:agents("guard")[1].both, 3)
end)

test("a number that is not finite is not pushed onto a list, and told", function()
  local machine = [[local mine = memory { times = list(3), gone = nobody }
    return machine { name = "m", start = "A", states = {
      A = { steer = hold, { to = "B", when = after(0.1), set = { times = mine.times:push(distance(mine.gone)) } } },
      B = { steer = hold } } }]]
  local s = scene { groups = { one = { behaviour = machine, at = { { 0, 0 } } } } }
  s:run(0.3)
  equal(#s:agents("one")[1].times, 0)
end)

test("where one was last seen is the nearest image across joined edges", function()
  local seeker = [[local mine = memory { prey = nobody }
    return machine { name = "seeker", start = "Follow", defaults = { perception = 6, speed = 1 }, states = {
      Follow = { steer = seek(mine.prey), set = { prey = nearest "prey" },
        { to = "Look", when = ~exists(mine.prey) & after(1) } },
      Look = { steer = seek(last_seen(mine.prey)), { to = "Found", when = near(last_seen(mine.prey), 0.3) } },
      Found = { steer = hold } } }]]
  local prey = [[return machine { name = "prey", start = "Go", states = {
    Go = { steer = drift(0.3, 0), { to = "Gone", when = after(6) } }, Gone = { removes = true } } }]]
  local s = scene { bounds = { { -4, -4 }, { 4, 4 } }, periodic = "x", groups = {
    seeker = { behaviour = seeker, at = { { -3.5, 0 } } },
    prey = { behaviour = prey, at = { { 2.5, 0 } }, tags = { "prey" } } } }
  s:reaches("Found", { agents = "seeker", within = 12 })
end)

test("one may hold, and tell, oneself", function()
  local machine = [[local mine = memory { whom = nobody, heard = 0 }
    return machine { name = "m", start = "A", states = { A = { steer = hold,
      on_enter = function(me) me.whom = me; me.tell(me, "note", { v = 3 }); me:tell(me, "note", { v = 4 }) end,
      { when = told "note", set = { heard = mine.heard + told("note").v } } } } }]]
  local s = scene { groups = { one = { behaviour = machine, at = { { 0, 0 } } } } }
  s:run(0.5)
  local one = s:agents("one")[1]
  equal(one.whom, one.id)
  equal(one.heard, 7)
end)

test("a filter takes those of whom public memory is false", function()
  local function stander(name, ill)
    return [[ memory { ill = false }
      return machine { name = "]] .. name .. [[", start = "Stand", public = { "ill" },
        states = { Stand = { steer = hold, set = { ill = ]] .. ill .. [[ } } } }]]
  end
  local s = scene { groups = {
    ill = { behaviour = stander("patient", "true"), at = { { 1, 0 } } },
    well = { behaviour = stander("visitor", "false"), at = { { 3, 0 } } },
    looker = { at = { { 0, 0 } }, behaviour = [[
      local mine = memory { ill = nobody, well = nobody }
      return machine { name = "looker", start = "Look", defaults = { perception = 9 }, states = {
        Look = { steer = hold, { to = "Done", when = after(0.1), set = {
          ill = nearest("anyone"):where("ill", true), well = nearest("anyone"):where("ill", false) } } },
        Done = { steer = hold } } }]] } } }
  s:run(1)
  equal(s:agents("looker")[1].ill, s:agents("ill")[1].id)
  equal(s:agents("looker")[1].well, s:agents("well")[1].id)
  refused({ groups = { looker = { at = { { 0, 0 } }, behaviour = [[
    return machine { name = "looker", start = "Look", states = {
      Look = { { to = "Look", when = sees(nearest("anyone"):where("ill", "no")) } } } }]] } } }, "true or false")
end)

test("a list that is declared wrongly is told once", function()
  local wrong = { groups = { looker = { at = { { 0, 0 } }, behaviour = [[
    local mine = memory { met = list(20, nobody) }
    return machine { name = "looker", start = "Look", states = {
      Look = { { to = "Done", when = after(1) | mine.met:contains(other), set = { met = mine.met:clear() } },
        { to = "Done", when = after(2) } }, Done = { steer = hold } } }]] } } }
  refused(wrong, "list takes a length")
  truthy(not pcall(refused, wrong, "memory 'met'"))
  truthy(not pcall(refused, wrong, "unknown key"))
  truthy(not pcall(refused, wrong, "always taken"))
end)

test("an item rests on a message by its values, too, and uses it up", function()
  for _, when in ipairs { '(told "x").v:above(0)', 'exists((told "x").sender)', 'either(told "x", 1, 0):above(0)',
    '~(~told "x")', 'told "x" & told("x").v:is(1)', '~told "y" & told "x"' } do
    local s = scene { groups = { people = { at = { { 0, 0 }, { 1, 0 } }, behaviour = [[
      local mine = memory { n = 0, home = false, seen = false, other = nobody }
      return machine { name = "people", start = "A", defaults = { perception = 9 }, states = {
        A = { steer = seek(home), tell = { neighbours "anyone", "x", v = 1 },
          { when = ]] .. when .. [[, set = { n = mine.n + 1 } },
          { when = after(9) & told "y", set = { n = 0 } },
          { every = 0.5, when = exists(home), set = { home = true, other = nearest "anyone" } },
          { every = 0.5, when = exists(last_seen(mine.other)), set = { seen = true } } } } }]] } } }
    s:run(2)
    for _, one in ipairs(s:agents("people")) do
      equal(one.n, 1)
      truthy(one.home)
      truthy(one.seen)
    end
  end
end)

test("a name is not empty", function()
  for _, item in ipairs { 'when = told ""', 'when = heard ""', 'signal = ""', 'tell = { nearest "anyone", "" }',
    'tell = { nearest "anyone", "x", [""] = 1 }', 'when = sees(nearest("anyone"):in_state "")' } do
    refused({ groups = { people = { at = { { 0, 0 } }, behaviour = [[
      return machine { name = "people", start = "A", states = { A = { steer = hold, { to = "B", ]] .. item .. [[ } },
        B = { steer = hold } } }]] } } }, "name")
  end
end)
