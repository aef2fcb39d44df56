local measure = require "measure"

local WIDE = { 0.8, 1, 1.2 } -- m
local function opening_of(wide)
  local low, high = 5 - wide / 2, 5 + wide / 2
  return { ["walls.1.solid.2.1"] = low, ["walls.1.solid.3.1"] = low, ["walls.2.solid.0.1"] = high, ["walls.2.solid.1.1"] = high }
end
local runs, quick, expect, measured = {}, {}, {}, {}
for i = 1, #WIDE do
  local name = string.format("w%03.0f", 100 * WIDE[i])
  runs[name] = { scene = "../rimea-12-long.yaml", seeds = "101-110", set = opening_of(WIDE[i]) }
  quick[name] = { seeds = 1 }
  expect[i] = { name, unit = "1/s", what = string.format("flow, %g m wide", WIDE[i]), reported = true,
    source = string.format("%.2f (1.9 per metre)", 1.9 * WIDE[i]) }
  measured[i] = { WIDE[i], name }
end
expect[#expect + 1] = { "falls", what = "widths at which the flow is not greater than at the one before",
  source = "rises with width", band = { 0, 0 } }

return claim {
  id = "R12d", title = "RiMEA 12d: how wide the opening is",
  source = "RiMEA 4.1.1, test 12d, as implemented by the verification notebooks of JuPedSim",
  text = "150 people go through an opening 5 m long. The wider it is, the greater is the flow.",
  level = "normal", held_out = measure.walking_law,
  runs = runs, quick = quick,
  null = { text = "all openings 1 m wide", set = opening_of(1) },
  measure = function(run)
    local out, flows = { falls = 0 }, {}
    for i = 1, #WIDE do
      local name = string.format("w%03.0f", 100 * WIDE[i])
      flows[i] = run[name].summary.probes.opening.flow
      out[name] = flows[i]
      if i > 1 and flows[i] <= flows[i - 1] then out.falls = out.falls + 1 end
    end
    return out
  end,
  expect = expect,
  plots = { { name = "flow", title = "RiMEA 12d: flow and width", x = "width (m)", y = "flow (1/s)",
    { "Jostle", figures = measured }, { "1.9 per metre", line = { { 0.8, 1.52 }, { 1.2, 2.28 } } } } },
  pictures = { w100 = { "opening.png" } },
}
