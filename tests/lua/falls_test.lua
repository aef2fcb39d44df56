-- Falls in behaviours: who has fallen knows it, others find and help those who lie.
local FALLER = [[return machine { name = "faller", start = "Stand", states = {
  Stand = { steer = hold, { to = "Down", when = fallen } },
  Down = { steer = hold, { to = "Up", when = ~fallen } },
  Up = { steer = hold } } }]]
local HELPER = [[local down = nearest("people"):fallen()
  return machine { name = "helper", start = "Look", defaults = { perception = 8 }, states = {
  Look = { steer = hold, { to = "Go", when = sees(down) } },
  Go = { steer = seek(down), { to = "Help", when = near(down, 0.8) } },
  Help = { steer = hold, grasp = down, { to = "Done", when = ~sees(down) } },
  Done = { steer = hold } } }]]

-- Two people, of whom the one on the spot is thrown at 0.5 s; `helper`: a third, 2 m away.
local function thrown(helper)
  return scene {
    places = { spot = { polygon = { { -0.5, -0.5 }, { 0.5, -0.5 }, { 0.5, 0.5 }, { -0.5, 0.5 } } } },
    groups = {
      people = { behaviour = FALLER, at = { { 0, 0 }, { 0, 3 } }, tags = { "people" },
        set = { balance = 0.51, rise = 8 } },
      helpers = helper and { behaviour = HELPER, at = { { 2, -2 } } } or nil,
    },
    events = { { at = 0.5, push = "spot", force = { 2000, 0 }, lasts = 0.1 } },
  }
end

test("the thrown one lies for its time, and the other stands", function()
  local s = thrown(false)
  s:run(2)
  equal(s:count("Down"), 1)
  equal(s:count("Stand"), 1)
  local lying = 0
  for _, a in ipairs(s:agents("people")) do lying = lying + (a.fallen > 0 and 1 or 0) end
  equal(lying, 1)
  s:run(5)
  equal(s:count("Down"), 1)
  s:run(3)
  equal(s:count("Up"), 1)
end)

test("a helper finds the one who lies, and helps it up sooner", function()
  local s = thrown(true)
  s:run(7)
  equal(s:count("Up"), 1)
  equal(s:count("Done"), 1)
end)
