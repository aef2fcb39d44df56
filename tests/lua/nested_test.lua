-- Machines that states run: names, order of transitions and entries, clocks, what is inherited, `done` and `back`.
local PLACES = { yard = { polygon = { { 0, 0 }, { 20, 0 }, { 20, 20 }, { 0, 20 } } }, post = { point = { 15, 10 } } }

local function one(behaviour, set)
  return scene { places = PLACES, groups = { one = { behaviour = behaviour, at = { { 5, 10 } }, set = set } } }
end

test("a state runs a machine, whose states are named after it", function()
  local s = one [[
    local walk = machine { start = "Go", states = {
      Go = { steer = seek "post", { to = "Look", when = after(1) } },
      Look = { steer = hold, { to = "Go", when = after(1) } } } }
    return machine { name = "m", start = "Guard", states = {
      Guard = { runs = walk, { to = "Rest", when = after(3.5) } }, Rest = { steer = hold } } }]]
  equal(s:agent(0).state, "Guard.Go")
  s:run(1.5)
  equal(s:agent(0).state, "Guard.Look")
  s:run(1)
  equal(s:agent(0).state, "Guard.Go")
  equal(s:count("Guard"), 1)
  s:run(1.2)
  equal(s:agent(0).state, "Rest")
  equal(s:count("Guard"), 0)
end)

test("entries go from the outside in, exits from the inside out, of the levels that change", function()
  local s = one [[
    local mine = memory { log = 0 }
    local function note(digit) return function(me) me.log = me.log * 10 + digit end end
    return machine { name = "m", start = "A", states = {
      A = { { to = "Out", when = after(0.5) } },
      Out = { on_enter = note(1), on_exit = note(2),
        runs = machine { start = "B", states = {
          B = { on_enter = note(3), on_exit = note(4), { to = "C", when = after(1), on_take = note(5) } },
          C = { on_enter = note(6), on_exit = note(7) } } },
        { to = "A", when = after(2), on_take = note(8) } } } }]]
  s:run(0.6)
  equal(s:agent(0).log, 13)
  s:run(1)
  equal(s:agent(0).log, 13456)
  s:run(1)
  equal(s:agent(0).log, 13456728)
end)

test("a transition of the outer state comes first, and its chance is rolled once for all inner states", function()
  local s = scene { places = PLACES, groups = { many = { count = 200, ["in"] = "yard", behaviour = [[
    return machine { name = "m", start = "Out", states = {
      Out = { runs = machine { start = "B", states = {
          B = { steer = hold, { to = "C", when = after(0.1) } },
          C = { steer = hold, { to = "B", when = after(0.1) } } } },
        { to = "Left", when = after(0.05), chance = 0.5 } },
      Left = { steer = hold } } }]] } } }
  s:run(5)
  truthy(s:count("Left") > 70 and s:count("Left") < 130)
end)

test("the outer state's duration, clock and time are its own", function()
  local s = one [[
    return machine { name = "m", start = "Out", states = {
      Out = { lasts = 2, runs = machine { start = "B", states = {
          B = { lasts = 0.5, { to = "C", when = lasted } }, C = { lasts = 0.5, { to = "B", when = lasted } } } },
        { to = "Long", when = lasted & time_in_state:at_least(1.95) } },
      Long = { steer = hold } } }]]
  s:run(1.9)
  equal(s:count("Long"), 0)
  s:run(0.2)
  equal(s:count("Long"), 1)
end)

test("inner states inherit what they do not set", function()
  local s = one([[
    return machine { name = "m", start = "Out", defaults = { horizon = 2 }, states = {
      Out = { speed = 0.7, steer = seek "post", push = 30,
        runs = machine { start = "B", defaults = { horizon = 3, perception = 6, speed = 2 }, states = {
          B = { { to = "C", when = after(1) } },
          C = { speed = 0.2, perception = 2 * own.perception, { to = "D", when = after(1) } },
          D = { steer = hold } } } } } }]])
  s:run(0.1)
  local a = s:agent(0)
  truthy(math.abs(a.speed - 0.7) < 1e-6)
  equal(a.horizon, 2)
  equal(a.perception, 6)
  equal(a.push, 30)
  s:run(0.7)
  truthy(s:agent(0).x > 5.2)
  s:run(1)
  a = s:agent(0)
  truthy(math.abs(a.speed - 0.2) < 1e-6)
  equal(a.perception, 12)
end)

test("a machine ends, and the outer state finds it done", function()
  local s = one [[
    local short = machine { start = "B", states = { B = { { to = "C", when = after(1) } }, C = { ends = true } } }
    return machine { name = "m", start = "Out", states = {
      Out = { runs = machine { start = "In", states = {
          In = { runs = short, { to = "Last", when = done } }, Last = { ends = true, runs = short } } },
        { to = "Over", when = done } },
      Over = { steer = hold } } }]]
  equal(s:agent(0).state, "Out.In.B")
  s:run(0.95)
  equal(s:count("Over"), 0)
  s:run(0.3)
  equal(s:count("Over"), 1)
end)

test("back leads to where the agent was, at any depth", function()
  local s = one [[
    return machine { name = "m", start = "Out", states = {
      Out = { runs = machine { start = "B", states = {
          B = { { to = "C", when = after(0.3) } }, C = { { to = "B", when = after(2) } } } },
        { to = "Stop", when = after(0.5) } },
      Stop = { { to = "Wave", when = after(0.3) }, { to = back, when = after(0.8) } },
      Wave = { { to = back, when = after(0.2) } } } }]]
  s:run(0.6)
  equal(s:agent(0).state, "Stop")
  s:run(0.3)
  equal(s:agent(0).state, "Wave")
  s:run(0.25)
  equal(s:agent(0).state, "Stop")
end)

test("neighbours are in an outer state, and in states by their own names", function()
  local function seen(state)
    local s = scene { places = PLACES, groups = {
      one = { at = { { 5, 10 } }, behaviour = ([[
        return machine { name = "look", start = "Look", states = {
          Look = { { to = "Seen", when = sees(nearest("anyone"):in_state("%s")) } }, Seen = {} } }]]):format(state) },
      other = { at = { { 6, 10 } }, behaviour = [[
        return machine { name = "m", start = "Guard", states = {
          Guard = { runs = machine { start = "Walk", states = {
            Walk = { steer = hold }, Sit = { steer = hold } } } } } }]] } } }
    s:run(0.3)
    return s:count("Seen") == 1
  end
  truthy(seen "Guard")
  truthy(seen "Walk")
  truthy(seen "Guard.Walk")
  truthy(not seen "Guard.Sit")
end)

test("the steps of a sequence follow one another, and it ends", function()
  local s = one [[
    local mine = memory { turns = 0 }
    return machine { name = "m", start = "Do", defaults = { speed = 2 }, states = {
      Do = { { to = "Over", when = done }, runs = sequence {
        wait(0.5), "Go", seek "post",
        function(me) me.turns = me.turns + 1 end,
        { name = "Turn", steer = hold, face = "post", when = after(0.3), { to = "Go", when = mine.turns:at_least(9) } },
        sequence { wait(uniform(0.2, 0.3)) },
        { set = { turns = 5 } } } },
      Over = { steer = hold } } }]]
  equal(s:agent(0).state, "Do.1 wait")
  s:run(0.6)
  equal(s:agent(0).state, "Do.Go")
  s:reaches("Do.Turn", { within = 10 })
  near(s:agent(0).x, 15, 1.1)
  equal(s:agent(0).turns, 1)
  s:reaches("Over", { within = 1 })
  equal(s:agent(0).turns, 5)
end)

test("a behaviour may be a sequence itself", function()
  local s = one [[return sequence { name = "m", wait(0.2), { removes = true } }]]
  s:run(0.5)
  equal(s:count(), 0)
end)
