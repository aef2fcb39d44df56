-- A program that uses the module as its users would; run by tests/scenes/lua_module.sh with a folder to write into.
local jostle = require "jostle"
local folder = arg[1]

local function check(name, good) print((good and "ok " or "not ok ") .. name) end
local function fails(name, text, ...)
  local good, why = pcall(...)
  check(name, not good and why:find(text, 1, true))
  if good or not why:find(text, 1, true) then print(why) end
end

-- Steps, and what is read.
local scene = jostle.scene("scenes/catch.yaml", { seed = 3, threads = 1 })
check("a scene is loaded", scene:count() == 6 and scene:duration() == 60 and scene:time() == 0)
scene:step():step(9):run(4.5)
check("it is stepped to a time", math.abs(scene:time() - 5) < 1e-9)
check("the hash is that of the program", scene:hash() == os.getenv "JOSTLE_HASH")
local agents, x, ids = scene:agents(), scene:column "x", scene:column "id"
local same = #agents == 6 and #x == 6
for i = 1, 6 do
  for k = 1, 6 do
    if ids[k] == agents[i].id then same = same and math.abs(x[k] - agents[i].x) < 1e-9 end
  end
end
check("columns and agents agree", same)
check("an agent has a state", ({ Dodge = 1, Hit = 1, Fetch = 1, Aim = 1, Throw = 1 })[agents[1].state])
local summary = scene:summary()
check("figures are tables", summary.agents == 6 and summary.tally.you >= 0 and summary.seed == 3)

-- Errors.
fails("a column that there is not", "no column 'z'", scene.column, scene, "z")
fails("an input that makes no sense", "no verb 'dance'", scene.input, scene, "dance 7")
fails("an option that there is not", "no option 'sed'", jostle.scene, "scenes/catch.yaml", { sed = 1 })
fails("an option of another type", "seed must be a number", jostle.scene, "scenes/catch.yaml", { seed = "a" })
fails("a scene that there is not", "gone.yaml", jostle.scene, "gone.yaml")
fails("a path that there is not", "Did you mean 'count'?", jostle.scene, "scenes/catch.yaml", { set = { ["groups.red.cout"] = 3 } })
local function broken()
  local file = io.open(folder .. "/broken.yaml", "w"); file:write("jostle: 1\nduraton: 5\n"); file:close()
  jostle.scene(folder .. "/broken.yaml")
end
fails("an error has its line and column", "broken.yaml:2:1:", broken)
fails("  and the way out", "Did you mean 'duration'?", broken)
fails("a path with a zero byte", "zero byte", jostle.scene, "scenes/catch.yaml\0.lua")
fails("a value with a zero byte", "zero byte", jostle.scene, "scenes/catch.yaml", { set = { ["groups.red.count"] = "3\0" } })
fails("a signal with a zero byte", "zero byte", scene.signal, scene, "a\0b")
fails("a seed below 0", "0 or more", jostle.scene, "scenes/catch.yaml", { seed = -1 })
fails("steps below 0", "0 or more", scene.step, scene, -1)
fails("a time below 0", "0 to 1e9", scene.run, scene, -1)
fails("a time that is no number", "0 to 1e9", scene.run, scene, 0 / 0)
fails("another thing in place of a scene", "jostle.scene expected", scene.step, {})

-- Values that are set; probes; gates; recordings; messages.
local one = jostle.scene("scenes/circle.yaml", { set = { ["groups.crossing.count"] = 20 } })
check("values are set", one:count() == 20)
local text = [==[
jostle: 1
places: {here: {point: [0, 0], radius: 2}, there: {point: [9, 0], radius: 1}}
walls: [{line: [[4, -3], [4, 3]], name: gate}]
groups: {people: {count: 4, in: here, behaviour: talker.lua}}
probes: {passed: {flow: [[5, 3], [5, -3]]}}
]==]
local file = io.open(folder .. "/module.yaml", "w"); file:write(text); file:close()
file = io.open(folder .. "/talker.lua", "w")
file:write [[return machine { name = "talker", version = 1, start = "Go", states = { Go = { steer = seek "there",
  { to = "Stop", when = heard "stop" } }, Stop = { steer = hold, on_enter = function(me) print "halted" end } } }]]
file:close()
local said = {}
local gate = jostle.scene(folder .. "/module.yaml", { message = function(t) said[#said + 1] = t end })
gate:record(folder .. "/module.sqlite", 0.5):open("gate"):run(6):signal("stop"):run(1)
local passed = gate:probe "passed"
check("a gate is opened, and passed", #passed["time [s]"] == 4 and passed.passages[4] == 4)
local figures = gate:summary()
check("figures nest as in the file", figures.probes.passed.passages == 4 and figures.inputs[1].path:find "module.yaml" and #figures.mods == 0)
check("a signal is heard", gate:agents()[1].state == "Stop")
check("what behaviours print is heard", table.concat(said):find "halted")
fails("a probe that there is not", "no probe 'p'", gate.probe, gate, "p")
gate:close()
check("a recording is there", (io.open(folder .. "/module.sqlite", "rb") or { read = function() end }):read(6) == "SQLite")

-- Programs that close a scene while it is used.
local victim
victim = jostle.scene(folder .. "/module.yaml", { message = function() if victim then victim:close() end end })
victim:open("gate"):run(6)
fails("closed by its own message", "was closed while it was stepped", function() victim:signal("stop"):run(1) end)
local crowd = jostle.scene("scenes/circle.yaml")
for _ = 1, 100 do setmetatable({}, { __gc = function() crowd:close() end }) end
collectgarbage "restart"
fails("closed by what is collected while it is read", "is closed", function()
  for _ = 1, 1000 do crowd:agents() end
end)
local kept = setmetatable({}, { __mode = "v" })
do
  local own
  own = jostle.scene("scenes/catch.yaml", { message = function() return own end })
  kept[1] = own
end
collectgarbage() collectgarbage()
check("a scene whose message knows it is collected", kept[1] == nil)
local again = jostle.scene("scenes/catch.yaml")
fails("a recording twice", "recorded already", function()
  again:record(folder .. "/a.sqlite"):record(folder .. "/b.sqlite")
end)
fails("frames too far apart", "0 to 1e6", scene.record, scene, folder .. "/c.sqlite", 1e9)
fails("a seed that is no whole number", "seed must be a whole number", jostle.scene, "scenes/catch.yaml", { seed = 1 / 0 })

local tower = jostle.scene("scenes/nist-2-7.yaml")
check("a lift is seen", tower:lift("lift").mode == "in_use" and tower:lift("lift").capacity == 8 and tower:lift("none") == nil)
check("its mode is set", tower:lift("lift", "firemen"):lift("lift").mode == "firemen")
fails("the mode of no lift", "there is no lift 'left'", tower.lift, tower, "left", "in_use")

-- What is closed stays so; what is forgotten is collected.
do local last <close> = jostle.scene("scenes/catch.yaml"); last:step() end
for _ = 1, 20 do jostle.scene("scenes/catch.yaml"):step() end
collectgarbage()
scene:close()
fails("a closed scene", "is closed", scene.step, scene)
print "ok closed"
