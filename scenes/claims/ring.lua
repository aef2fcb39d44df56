-- Density in the ring, 1/m2, and mean speed there, m/s.
local points = {
  { 0.34, 1.11 }, { 0.73, 0.94 }, { 1.27, 0.70 }, { 1.71, 0.56 },
  { 2.26, 0.42 }, { 2.70, 0.35 }, { 3.27, 0.23 }, { 3.71, 0.17 },
}
local area = 100 -- m2

-- Who follows whom depends on where people stand at first, so both ways of the rows count.
local starts = { { "along", "../ring.yaml" }, { "across", "../ring-across.yaml" } }

local runs, quick, expect, curves = {}, {}, {}, {}
for k = 1, #starts do
  local start, scene, measured = starts[k][1], starts[k][2], {}
  for i = 1, #points do
    local density, speed = points[i][1], points[i][2]
    local name = string.format("%s%03.0f", start, 100 * density)
    runs[name] = { scene = scene, seeds = 3, set = { ["groups.people.count"] = math.floor(density * area + 0.5) } }
    quick[name] = { seeds = 1 }
    expect[#expect + 1] = { name, unit = "m/s",
      what = string.format("mean speed at %.2f people per square metre, rows %s the way", density, start),
      source = string.format("%.2f", speed), band = { 0.75 * speed, 1.25 * speed } }
    measured[i] = { density, name }
  end
  curves[k] = { "Jostle, rows " .. start .. " the way", figures = measured }
end

return claim {
  id = "F2", title = "Speed and density in a wide ring corridor, one way",
  source = "Juelich archive, ring corridor, unidirectional",
  text = "Everybody walks the same way round: a fundamental diagram over ten-fold density.",
  runs = runs, quick = quick,
  tried = {
    "a wider strip in which people look for whom they follow, 0.85 m: no better across, worse along",
    "a shorter time gap, 0.70 s, with the wider strip: the single file leaves its band",
    "a speed that the density about a walker caps (kept, as it helps a little): more of it takes bottlenecks out of theirs",
  },
  measure = function(run)
    local out = {}
    for name in pairs(runs) do out[name] = run[name].summary.probes.middle.speed end
    return out
  end,
  expect = expect,
  plots = { { name = "diagram", title = "Ring corridor, one way: speed and density",
    x = "density (1/m²)", y = "mean speed (m/s)", curves[1], curves[2], { "Juelich archive", points = points } } },
  pictures = { along073 = { "paths.png" }, across270 = { "paths.png", "middle.png" } },
}
