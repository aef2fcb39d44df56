local measure = require "measure"

local densities = { 0.5, 1, 1.5, 2, 3, 4 } -- 1/m2
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
  expect[i] = measure.expected(name, "m/s", string.format("mean speed at %g people per square metre", d),
    weidmann(d), 0.35)
  measured[i] = { d, name }
end
expect[#expect + 1] = { "rises", source = "falls throughout", band = { 0, 0 },
  what = "densities at which people are not slower than at the one before" }
expect[#expect + 1] = { "flow", unit = "1/(m s)", reported = true, what = "greatest specific flow",
  source = "1.2 (Weidmann), 0.9 (F2)" }

for i = 1, 36 do law[i] = { 0.4 + 0.1 * i, weidmann(0.4 + 0.1 * i) } end

return claim {
  id = "F4", title = "The fundamental diagram, against Weidmann's",
  source = "Weidmann 1993",
  text = "One-way flow in a corridor 10 m wide, from random places: people are the slower the denser they walk. "
    .. "Diagrams of the literature differ by a third; those of the Juelich archive (F2) lie below Weidmann's.",
  level = "normal", held_out = measure.walking_law,
  runs = runs, quick = quick, null = measure.by_orca("people"),
  measure = function(run)
    local out, speeds, flows = {}, {}, {}
    for i = 1, #densities do
      local name = name_of(densities[i])
      local corridor = run[name].summary.probes.corridor
      speeds[i], flows[i], out[name] = corridor.speed, corridor.specific_flow, corridor.speed
    end
    out.rises, out.flow = measure.rises(speeds), measure.most(flows)
    return out
  end,
  expect = expect,
  tried = { "From three people per square metre on, normal people walk a third and more faster than by Weidmann; calm ones "
    .. "in the ring of F2 have the speeds recorded there." },
  plots = { { name = "diagram", title = "Speed and density", x = "density (1/m²)", y = "mean speed (m/s)",
    { "Jostle", figures = measured }, { "Weidmann 1993", line = law } } },
  pictures = { d200 = { "paths.png" } },
}
