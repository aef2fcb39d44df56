local measure = require "measure"

local densities = { 0.5, 1, 1.5, 2, 3, 4 } -- 1/m2
local area = 200                           -- m2

-- Mean speed at a density, m/s, after Weidmann 1993.
local function weidmann(density) return 1.34 * (1 - math.exp(-1.913 * (1 / density - 1 / 5.4))) end
local function name(density) return string.format("d%03.0f", 100 * density) end

local runs, quick, expect = {}, {}, {}
for i = 1, #densities do
  local d = densities[i]
  runs[name(d)] = { scene = "../rimea-04.yaml", seeds = 3, set = { ["groups.people.count"] = math.floor(d * area + 0.5) } }
  quick[name(d)] = { seeds = 1 }
  expect[i] = { name(d), unit = "m/s", what = string.format("mean speed at %g people per square metre", d),
    source = string.format("%.2f", weidmann(d)), band = { 0.65 * weidmann(d), 1.35 * weidmann(d) } }
end
expect[#expect + 1] = { "rises", what = "densities at which people are not slower than at the one before", source = "0", band = { 0, 0 } }
expect[#expect + 1] = { "flow", unit = "1/(m s)", what = "greatest specific flow", source = "1.2 (Weidmann), 0.9 (F2)", reported = true }

return claim {
  id = "R4", title = "RiMEA 4: the fundamental diagram",
  source = "RiMEA guideline, test 4; Weidmann 1993",
  text = "One-way flow in a corridor 10 m wide: people are the slower the denser they walk. Diagrams of the literature differ by a third; those of the Juelich archive (F2) lie below Weidmann's.",
  runs = runs, quick = quick,
  measure = function(run)
    local out, speeds, flows = {}, {}, {}
    for i = 1, #densities do
      local probe = run[name(densities[i])].summary.probes.corridor
      speeds[i], flows[i] = probe.speed, probe.density_classical * probe.speed
      out[name(densities[i])] = probe.speed
    end
    out.rises, out.flow = measure.rises(speeds), measure.most(flows)
    return out
  end,
  expect = expect,
  pictures = { d100 = { "paths.png", "corridor.png" }, d300 = { "corridor.png" } },
}
