local measure = require "measure"

-- Density in the ring, 1/m2, and mean speed there, m/s.
local points = {
  { 0.34, 1.11 }, { 0.73, 0.94 }, { 1.27, 0.70 }, { 1.71, 0.56 },
  { 2.26, 0.42 }, { 2.70, 0.35 }, { 3.27, 0.23 }, { 3.71, 0.17 },
}
local area = 100 -- m2

local runs, quick, expect, measured = {}, {}, {}, {}
for i = 1, #points do
  local density, speed = points[i][1], points[i][2]
  local name = string.format("d%03.0f", 100 * density)
  runs[name] = { scene = "../ring.yaml", seeds = "101-110",
    set = { ["groups.people.count"] = math.floor(density * area + 0.5) } }
  quick[name] = { seeds = 1 }
  expect[i] = measure.expected(name, "m/s",
    string.format("mean speed at %.2f people per square metre", density), speed, 0.25)
  measured[i] = { density, name }
end

return claim {
  id = "F2", title = "Speed and density in a wide ring corridor, one way",
  source = "Juelich archive, ring corridor, unidirectional",
  text = "Everybody walks the same way round, from random places: a fundamental diagram over ten-fold density.",
  level = "calm", calibrated = measure.walking_law,
  runs = runs, quick = quick, null = measure.half_gap(),
  measure = function(run)
    local out = {}
    for name in pairs(runs) do out[name] = run[name].summary.probes.middle.speed end
    return out
  end,
  expect = expect,
  plots = { { name = "diagram", title = "Ring corridor, one way: speed and density",
    x = "density (1/m²)", y = "mean speed (m/s)", { "Jostle", figures = measured },
    { "Juelich archive", points = points } } },
  pictures = { d073 = { "paths.png" }, d270 = { "paths.png", "middle.png" } },
}
