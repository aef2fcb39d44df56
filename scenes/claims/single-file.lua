-- Density along the ring, 1/m, and mean speed there, m/s.
local points = {
  { 0.55, 0.99 }, { 0.71, 0.90 }, { 0.87, 0.85 }, { 1.11, 0.58 }, { 1.28, 0.42 },
  { 1.49, 0.29 }, { 1.71, 0.22 }, { 1.92, 0.15 }, { 2.09, 0.10 },
}
local length = 26.84 -- m, round the ring

local runs, expect, measured = {}, {}, {}
for i = 1, #points do
  local density, speed, name = points[i][1], points[i][2], string.format("d%03.0f", 100 * points[i][1])
  runs[name] = { scene = "../single-file.yaml", seeds = 5,
    set = { ["groups.people.count"] = math.floor(density * length + 0.5) } }
  expect[i] = { name, unit = "m/s", what = string.format("mean speed at %.2f people per metre", density),
    source = string.format("%.2f", speed), band = { speed - 0.12, speed + 0.12 } }
  measured[i] = { density, name }
end

return claim {
  id = "F1", title = "Speed and density in single file",
  source = "Seyfried et al. 2005, doi 10.1088/1742-5468/2005/10/P10002, and later sets of the Juelich archive",
  text = "People one behind the other in a ring of 26.84 m: the more, the slower, by the way ahead that each has.",
  runs = runs,
  measure = function(run)
    local out = {}
    for name in pairs(runs) do out[name] = run[name].summary.probes.ring.speed end
    return out
  end,
  expect = expect,
  plots = { { name = "diagram", title = "Single file: speed and density", x = "density (1/m)", y = "mean speed (m/s)",
    { "Jostle, mean of the seeds, least to most", figures = measured }, { "measured by others", points = points } } },
  pictures = { d055 = { "ring.png" }, d171 = { "ring.png" } },
}
