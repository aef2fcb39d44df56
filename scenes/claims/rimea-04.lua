local measure = require "measure"

local densities = { 0.5, 1, 1.5, 2, 3, 4 } -- 1/m2
local area = 200                           -- m2

-- Who follows whom depends on where people stand at first, so both ways of the rows count.
local starts = { { "along", "../rimea-04.yaml" }, { "across", "../rimea-04-across.yaml" } }

-- Mean speed at a density, m/s, after Weidmann 1993.
local function weidmann(density) return 1.34 * (1 - math.exp(-1.913 * (1 / density - 1 / 5.4))) end
local function name_of(start, density) return string.format("%s%03.0f", start, 100 * density) end

local runs, quick, expect, curves, law = {}, {}, {}, {}, {}
for k = 1, #starts do
  local start, scene, measured = starts[k][1], starts[k][2], {}
  for i = 1, #densities do
    local d = densities[i]
    local name = name_of(start, d)
    runs[name] = { scene = scene, seeds = 3, set = { ["groups.people.count"] = math.floor(d * area + 0.5) } }
    quick[name] = { seeds = 1 }
    expect[#expect + 1] = { name, unit = "m/s",
      what = string.format("mean speed at %g people per square metre, rows %s the way", d, start),
      source = string.format("%.2f", weidmann(d)), band = { 0.65 * weidmann(d), 1.35 * weidmann(d) } }
    measured[i] = { d, name }
  end
  curves[k] = { "Jostle, rows " .. start .. " the way", figures = measured }
  expect[#expect + 1] = { "rises_" .. start, source = "0", band = { 0, 0 },
    what = "densities at which people are not slower than at the one before, rows " .. start }
  expect[#expect + 1] = { "flow_" .. start, unit = "1/(m s)", reported = true,
    what = "greatest specific flow, rows " .. start, source = "1.2 (Weidmann), 0.9 (F2)" }
end

for i = 1, 36 do law[i] = { 0.4 + 0.1 * i, weidmann(0.4 + 0.1 * i) } end

return claim {
  id = "R4", title = "RiMEA 4: the fundamental diagram",
  source = "RiMEA guideline, test 4; Weidmann 1993",
  text = "One-way flow in a corridor 10 m wide: people are the slower the denser they walk. "
    .. "Diagrams of the literature differ by a third; those of the Juelich archive (F2) lie below Weidmann's.",
  runs = runs, quick = quick,
  tried = {
    "a wider strip in which people look for whom they follow, 0.85 m: no better across, worse along",
    "a shorter time gap, 0.70 s, with the wider strip: the single file leaves its band",
    "a speed that the density about a walker caps (kept, as it helps a little): more of it takes bottlenecks out of theirs",
  },
  measure = function(run)
    local out = {}
    for k = 1, #starts do
      local speeds, flows, start = {}, {}, starts[k][1]
      for i = 1, #densities do
        local name = name_of(start, densities[i])
        local probe = run[name].summary.probes.corridor
        speeds[i], flows[i], out[name] = probe.speed, probe.density_classical * probe.speed, probe.speed
      end
      out["rises_" .. start], out["flow_" .. start] = measure.rises(speeds), measure.most(flows)
    end
    return out
  end,
  expect = expect,
  plots = { { name = "diagram", title = "One-way flow in a corridor: speed and density",
    x = "density (1/m²)", y = "mean speed (m/s)", curves[1], curves[2], { "Weidmann 1993", line = law } } },
  pictures = { along100 = { "paths.png", "corridor.png" }, across300 = { "corridor.png" } },
}
