-- Every test here must fail: on the line that ends with an arrow, and with the text behind it.
-- luacheck: ignore 111 113 241 331
local function standing(count)
  return {
    places = { yard = { polygon = { { 0, 0 }, { 9, 0 }, { 9, 9 }, { 0, 9 } } } },
    groups = { people = { behaviour = "stander.lua", count = count or 1, fill = "grid", ["in"] = "yard" } },
  }
end
local function walking()
  return {
    places = { goal = { point = { 5, 0 } } },
    groups = {
      late = { behaviour = "walker.lua", at = { { -20, 3 } }, set = { goal = "goal", speed = 1 } },
      soon = { behaviour = "walker.lua", at = { { 2, 0 } }, set = { goal = "goal", speed = 1 } },
    },
  }
end

-- assertions of values
test("equal", function()
  equal(1 + 1, 3) --> 2 is not 3
end)
test("equal tells types apart", function()
  equal("1", 1) --> 1 is not 1
end)
test("near", function()
  near(1.5, 1, 0.25) --> 1.5 is not within 0.25 of 1.0
end)
test("near of what is no number", function()
  near(0 / 0, 1, 1e9) --> is not within
end)
test("near wants a tolerance", function()
  near(1, 1) --> number expected, got no value
end)
test("truthy", function()
  truthy(false) --> this is not true
end)
test("truthy with words of one's own", function()
  truthy(nil, "the door is shut") --> the door is shut
end)
test("fails", function()
  fails(function() end) --> this does not fail
end)
test("fails with another text", function()
  fails(function() error("apples") end, "pears") --> this fails, but not with 'pears':
end)

-- assertions of scenes
test("reaches in too short a time", function()
  local s = scene(walking())
  s:reaches("Gone", { within = 6 }) --> 1 of 2 agents reached 'Gone' within 6.0 s; now at t = 6.0 s: Walk 1
end)
test("reaches of a group", function()
  local s = scene(walking())
  s:reaches("Gone", { within = 6, agents = "soon" })
  s:reaches("Gone", { within = 2, agents = "late" }) --> 0 of 1 agents reached 'Gone' within 2.0 s
end)
test("reaches by more than there are", function()
  local s = scene(standing(3))
  s:reaches("Stand", { within = 0.5, count = 4 }) --> 3 of 4 agents reached 'Stand' within 0.5 s
end)
test("never, but it is so from the start", function()
  local s = scene(standing())
  s:never("Stand", { during = 1 }) --> agent 0 has been in 'Stand', by t = 0.0 s
end)
test("never, but it comes", function()
  local s = scene(walking())
  s:never("Gone", { during = 2, agents = "late" })
  s:never("Gone", { during = 20 }) --> agent 1 has been in 'Gone', by t =
end)
test("never counts what was before", function()
  local s = scene(walking())
  s:run(8)
  s:never("Gone") --> agent 1 has been in 'Gone', by t = 8.0 s
end)
test("slower_than", function()
  local s = scene(walking())
  s:slower_than(0.4, { during = 3 }) --> m/s at t =
end)
test("slower_than of a group", function()
  local s = scene(walking())
  s:slower_than(0.4, { during = 3, agents = "late" }) --> agent 0 moves at
end)
test("faster_than", function()
  local s = scene(standing())
  s:faster_than(0.1, { during = 1 }) --> agents move at 0.0 m/s on the average, not faster than 0.1
end)
test("refused, but it loads", function()
  refused(standing(), "anything") --> the scene loads, and should not
end)
test("refused for something else", function()
  refused({ groups = {} }, "pears") --> the scene is refused, but not for 'pears':
end)

-- tests that are wrong themselves
test("this asserts nothing", function() --> this test asserts nothing
  local s = scene(standing())
  s:run(1)
end)
test("an error is a failure", function()
  local nothing
  nothing.x = 1 --> attempt to index a nil value (local 'nothing')
end)
test("an error without a text is one too", function()
  error({}) --> error needs a text
end)
test("a state that no machine has", function()
  scene(standing()):count("Stnd") --> no machine of the scene has a state 'Stnd'; did you mean Stand
end)
local function nested()
  return {
    groups = {
      people = { at = { { 0, 0 } }, behaviour = [[
        local mine = memory { laps = 0, friend = nobody }
        return machine { name = "nested", start = "Guard", own = { shoe = 44 }, states = {
          Guard = { runs = sequence { wait(9), wait(9) }, speed = own.shoe / 40, set = { friend = nobody },
            { to = "Rest", when = same(mine.friend, nearest "anyone") } },
          Rest = { steer = hold, set = { laps = mine.laps + 1 } } } }]] },
      others = { at = { { 3, 0 } }, behaviour = [[return machine { name = "other", start = "Rest",
        states = { Rest = { steer = hold } } }]] },
    },
  }
end
test("a state of a nested machine by its last name", function()
  scene(nested()):count("1 wait") --> has a state '1 wait'; did you mean Guard.1 wait
end)
test("a field that an agent does not have", function()
  equal(scene(nested()):agents("people")[1].lap, nil) --> an agent has no 'lap'; did you mean laps
end)
test("an own value as a field of the agent", function()
  equal(scene(nested()):agents("people")[1].shoe, 44) --> an agent has no 'shoe'; it is an own value: own.shoe
end)
test("memory as an own value", function()
  equal(scene(nested()):agents("people")[1].own.laps, nil) --> 'laps' is no own value; memory and parameters are fields
end)
test("an own value that an agent does not have", function()
  equal(scene(nested()):agents("people")[1].own.sho, nil) --> the agent has no own value 'sho'; did you mean own.shoe
end)
test("a state that some machines do not have", function()
  scene(nested()):reaches("Guard", { within = 1 }) --> the machine of 1 of them has no such state
end)
test("agents in states of one name of two machines are counted once", function()
  scene(nested()):reaches("Guard", { within = 1 }) --> t = 1.0 s: Rest 1, Guard.1 wait 1; the
end)
test("a group that the scene lacks", function()
  scene(standing()):agents("poeple") --> the scene has no group 'poeple'
end)
test("a body that the scene lacks", function()
  scene(standing()):body("ball") --> the scene has no body 'ball'
end)
test("an option that is misspelt", function()
  scene(standing()):reaches("Stand", { whitin = 3 }) --> there is no option 'whitin'; did you mean within
end)
test("an option of the wrong kind", function()
  scene(standing()):reaches("Stand", { within = "soon" }) --> option 'within' must be a number
end)
test("a number where options belong", function()
  scene(standing()):reaches("Stand", 10) --> table expected, got number
end)
test("a scene that is refused says why", function()
  local bad = standing()
  bad.gruops = {}
  scene(bad) --> the scene is refused: unknown key 'gruops' of a scene
end)
test("a file that is not there", function()
  scene("nowhere.yaml") --> No such file or directory
end)
test("a table that contains itself", function()
  local round = standing()
  round.places.round = round
  scene(round) --> too deep or too large
end)
test("a function in a scene", function()
  scene { groups = print } --> 'groups' of a scene cannot be a function
end)
test("too many threads", function()
  scene(standing(), { threads = 1000 }) --> threads must be from 1 to 64
end)
test("a test within a test", function()
  test("inner", function() end) --> a test cannot contain another test
end)
test("what no scene can do", function()
  scene(standing()):fly() --> attempt to call a nil value (method 'fly')
end)
test("a method of something else", function()
  scene(standing()).count(7) --> jostle scene expected, got number
end)

-- what a test file cannot reach
test("no files", function()
  io.open("x") --> unknown name 'io'
end)
test("no clock", function()
  os.time() --> unknown name 'os'
end)
test("no code from texts", function()
  loadstring("return 1")() --> unknown name 'loadstring'
end)
test("no metatables", function()
  getmetatable(scene(standing())) --> unknown name 'getmetatable'
end)
test("no globals", function()
  kept = 1 --> globals cannot be set
end)
