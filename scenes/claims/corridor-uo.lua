local measure = require "measure"
local about = measure.about

-- Widths of entrance, corridor and exit, cm; specific flow, 1/(m s); density, 1/m2; speed, m/s.
local cases = {
  { "100-180-180", 1.32, 1.12, 1.21 },
  { "180-180-120", 1.34, 2.04, 0.68 },
  { "180-180-070", 0.95, 2.98, 0.37 },
}

local runs, quick, expect, pictures, measured, source = {}, {}, {}, {}, {}, {}
for i = 1, #cases do
  local name, flow, density, speed = table.unpack(cases[i])
  runs[name], quick[name] = { scene = "../corridor-uo-" .. name .. ".yaml", seeds = "101-110" }, { seeds = 2 }
  pictures[name] = { "paths.png", "middle.png" }
  local function add(figure, unit, what, value, share)
    expect[#expect + 1] = { figure .. " " .. name, unit = unit, what = what .. ", " .. name,
      source = string.format("%.2f", value), band = about(value, share) }
  end
  add("flow", "1/(m s)", "specific flow in the corridor", flow, 0.15)
  add("density", "1/m2", "density in its middle", density, 0.25)
  add("speed", "m/s", "speed there", speed, 0.25)
  measured[i], source[i] = { density, "speed " .. name }, { density, speed }
end

return claim {
  id = "F3", title = "A corridor of 1.8 m with an entrance and an exit",
  source = "Zhang et al. 2011, doi 10.1088/1742-5468/2011/06/P06004 (unidirectional, open; widths in cm), measured with the "
    .. "scenes' own probes",
  text = "A narrow entrance leaves the corridor free; a narrow exit fills it, and people shuffle. They come in where and when the camera saw them first.",
  level = "calm", calibrated = measure.walking_law,
  runs = runs, quick = quick,
  measure = function(run)
    local out = {}
    for name in pairs(runs) do
      local probes = run[name].summary.probes
      out["flow " .. name] = probes.line.specific_flow
      out["density " .. name] = probes.middle.density
      out["speed " .. name] = probes.middle.speed
    end
    return out
  end,
  expect = expect,
  plots = { { name = "diagram", title = "Speed in the middle of the corridor, at the densities of the source",
    x = "density measured by the source (1/m²)", y = "mean speed (m/s)",
    { "Jostle, the same widths", figures = measured }, { "Zhang et al. 2011", points = source } } },
  pictures = pictures,
}
