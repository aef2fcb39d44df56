local measure = require "measure"

local FAR = { 0.4, 1, 2, 4, 8 } -- m, from the opening to the goal
local function goal_at(far) -- places the goal, from 0.2 m, the depth of the opening, on
  local x = 10.2 + far
  return { ["places.goal.polygon.0.0"] = x, ["places.goal.polygon.3.0"] = x,
    ["places.goal.polygon.1.0"] = x + 0.5, ["places.goal.polygon.2.0"] = x + 0.5 }
end
local runs, quick, expect = {}, {}, {}
for i = 1, #FAR do
  local name = "a" .. i
  runs[name] = { scene = "../rimea-12.yaml", seeds = "101-110", set = goal_at(FAR[i]) }
  quick[name] = { seeds = 1 }
  expect[i] = { name, unit = "s", what = string.format("until the first room is empty, goal at %g m", FAR[i]),
    source = "none", reported = true }
end
expect[#expect + 1] = { "rise", unit = "s", what = "how much longer it takes with a goal at 8 m than with one at 0.4 m",
  source = "longer; 0.05 s ours", band = { 0.05 } }
expect[#expect + 1] = { "constant", what = "time with a goal at 8 m over that at 4 m", source = "constant; 5 % ours",
  band = { 0.95, 1.05 } }

return claim {
  id = "R12a", title = "RiMEA 12a: how far the goal is",
  source = "RiMEA 4.1.1, test 12a, as implemented by the verification notebooks of JuPedSim",
  text = "150 people go from a room to another by an opening of 1 m. The farther their goal lies behind it, the longer the "
    .. "first room takes to empty, up to a distance from which on it stays the same.",
  level = "normal", held_out = measure.walking_law,
  runs = runs, quick = quick,
  null = { text = "all goals at 8 m", set = goal_at(FAR[#FAR]) },
  measure = function(run)
    local out = {}
    for i = 1, #FAR do out["a" .. i] = run["a" .. i].summary.probes.opening.last end
    out.rise, out.constant = out.a5 - out.a1, out.a5 / out.a4
    return out
  end,
  expect = expect,
  pictures = { a4 = { "opening.png", "density.png" } },
}
