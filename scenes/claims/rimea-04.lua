local measure = require "measure"

local densities = { 0.5, 1, 1.5, 2, 3, 4, 5, 6 } -- 1/m2
local area = 200                           -- m2

-- Mean speed at a density, m/s, after Weidmann 1993.
local function weidmann(density) return 1.34 * (1 - math.exp(-1.913 * (1 / density - 1 / 5.4))) end
local function name_of(density) return string.format("d%03.0f", 100 * density) end

local runs, quick, expect, measured, law = {}, {}, {}, {}, {}
for i = 1, #densities do
  local d = densities[i]
  local name = name_of(d)
  runs[name] = { scene = "../rimea-04.yaml", seeds = "101-110",
    set = { ["groups.people.count"] = math.floor(d * area + 0.5) } }
  quick[name] = { seeds = 1 }
  expect[i] = { name, unit = "m/s", what = string.format("mean speed at %g people per square metre", d), reported = true,
    source = string.format("%.2f (Weidmann)", math.max(0, weidmann(d))) }
  measured[i] = { d, name }
end
expect[#expect + 1] = { "rises", source = "ours: they fall", band = { 0, 0 },
  what = "densities at which people are not slower than at the one before" }
expect[#expect + 1] = { "areas", source = "ours: three areas agree", band = { 0, 0.15 },
  what = "greatest difference of the flow in an area from that in all three, at 1 to 4 people per square metre" }
expect[#expect + 1] = { "flow", unit = "1/(m s)", reported = true, what = "greatest specific flow",
  source = "1.2 (Weidmann), 0.9 (F2)" }

for i = 1, 49 do law[i] = { 0.4 + 0.1 * i, weidmann(0.4 + 0.1 * i) } end

return claim {
  id = "R4", title = "RiMEA 4: the fundamental diagram",
  source = "RiMEA 4.1.1, test 4, as implemented by the verification notebooks of JuPedSim; Weidmann 1993",
  text = "One-way flow in a corridor 10 m wide, from random places: people are the slower the denser they walk. "
    .. "The test asks to compare speed and flow over density with the literature, which differs by a third, and has no "
    .. "threshold: F4 judges the same runs by Weidmann's diagram. Three areas are measured, which are to agree.",
  level = "normal", held_out = measure.walking_law,
  runs = runs, quick = quick,
  null = { text = "the same number of people in all runs, two per square metre", set = { ["groups.people.count"] = 2 * area } },
  measure = function(run)
    local out, speeds, flows = {}, {}, {}
    for i = 1, #densities do
      local name = name_of(densities[i])
      local corridor = run[name].summary.probes.corridor
      speeds[i], flows[i], out[name] = corridor.speed, corridor.specific_flow, corridor.speed
    end
    out.areas = 0
    for _, d in ipairs { 1, 2, 3, 4 } do
      local probes = run[name_of(d)].summary.probes
      local three = { probes.west.specific_flow, probes.middle.specific_flow, probes.east.specific_flow }
      local mean = measure.mean(three)
      for i = 1, 3 do out.areas = math.max(out.areas, math.abs(three[i] / mean - 1)) end
    end
    out.rises, out.flow = measure.rises(speeds), measure.most(flows)
    return out
  end,
  expect = expect,
  plots = { { name = "diagram", title = "RiMEA 4: speed and density", x = "density (1/m²)", y = "mean speed (m/s)",
    { "Jostle", figures = measured }, { "Weidmann 1993", line = law } } },
  pictures = { d200 = { "density.png" } },
}
