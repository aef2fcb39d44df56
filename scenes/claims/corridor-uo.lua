-- Widths of entrance and exit, m; people; when the middle 60 % of them passed, s;
-- specific flow, 1/(m s); density, 1/m2; speed, m/s.
local cases = {
  { "100-180-180", 1.0, 1.8, 120, { 15, 45 }, 1.38, 1.14, 1.21 },
  { "180-180-120", 1.8, 1.2, 170, { 20, 62 }, 1.33, 2.04, 0.67 },
  { "180-180-070", 1.8, 0.7, 150, { 24, 76 }, 0.95, 3.06, 0.34 },
}

-- The same scene with other widths.
local function run(entrance, exit, people, during)
  local e, x = entrance / 2, exit / 2
  return { scene = "../corridor-uo.yaml", seeds = 6, set = {
    ["groups.people.count"] = people, ["probes.middle.from"] = during[1], ["probes.middle.until"] = during[2],
    ["places.entrance.line.0.1"] = e, ["places.entrance.line.1.1"] = -e,
    ["walls.0.line.2.1"] = e, ["walls.1.line.2.1"] = -e,
    ["places.exit.line.0.1"] = x, ["places.exit.line.1.1"] = -x,
    ["walls.3.line.4.1"] = x, ["walls.4.line.4.1"] = -x,
  } }
end

local runs, quick, expect, pictures, measured, source = {}, {}, {}, {}, {}, {}
for i = 1, #cases do
  local name, entrance, exit, people, during, flow, density, speed = table.unpack(cases[i])
  runs[name], quick[name], pictures[name] = run(entrance, exit, people, during), { seeds = 2 },
    { "paths.png", "middle.png" }
  local function add(figure, unit, what, source)
    expect[#expect + 1] = { figure .. " " .. name, unit = unit, what = what .. ", " .. name,
      source = string.format("%.2f", source), band = { 0.75 * source, 1.25 * source } }
  end
  add("flow", "1/(m s)", "specific flow in the corridor", flow)
  add("density", "1/m2", "density in its middle", density)
  add("speed", "m/s", "speed there", speed)
  measured[i], source[i] = { density, "speed " .. name }, { density, speed }
end

return claim {
  id = "F3", title = "A corridor of 1.8 m with an entrance and an exit",
  source = "Zhang et al. 2011, doi 10.1088/1742-5468/2011/06/P06004 (unidirectional, open; widths in cm)",
  text = "A narrow entrance leaves the corridor free; a narrow exit fills it, and people shuffle.",
  runs = runs, quick = quick,
  measure = function(run)
    local out = {}
    for name in pairs(runs) do
      local probes = run[name].summary.probes
      out["flow " .. name] = probes.flow.flow / 1.8
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
