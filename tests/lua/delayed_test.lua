-- delayed.lua: people stand for their pre-movement time, then walk to their goal.
local function room(premovement)
  return {
    places = { goal = { polygon = { { 10, 0 }, { 12, 0 }, { 12, 4 }, { 10, 4 } } } },
    groups = {
      people = { behaviour = "delayed.lua", at = { { 1, 1 }, { 1, 3 } },
        set = { goal = "goal", premovement = premovement } },
    },
  }
end

test("nobody moves before the time, and all arrive after it", function()
  local s = scene(room(5))
  s:run(4.9)
  for _, a in ipairs(s:agents()) do near(a.x, 1, 0.01) end
  equal(s:count("Wait"), 2)
  s:reaches("Gone", { within = 20 })
  equal(s:count(), 0)
end)

test("times of a distribution differ from person to person", function()
  local s = scene(room("weibull(1.2, 10, 0.5, 60)"))
  s:run(1)
  s:reaches("Gone", { within = 90 })
end)
