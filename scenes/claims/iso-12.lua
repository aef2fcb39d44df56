local measure = require "measure"

local WIDE = { 1, 1.2, 1.4, 1.6, 1.8 } -- m
local function stair_of(wide)
  local low, high = 5 - wide / 2, 5 + wide / 2
  return { ["stairs.stair.width"] = wide, ["walls.0.line.0.1"] = low, ["walls.0.line.9.1"] = high,
    ["walls.1.line.0.1"] = low, ["walls.1.line.5.1"] = high }
end
local runs, quick, expect, measured = {}, {}, {}, {}
for i = 1, #WIDE do
  local name = string.format("w%03.0f", 100 * WIDE[i])
  runs[name] = { scene = "../iso-12.yaml", seeds = "101-105", set = stair_of(WIDE[i]) }
  quick[name] = { seeds = 1 }
  expect[i] = { name, unit = "1/s", what = string.format("flow up, %g m wide", WIDE[i]), source = "none", reported = true }
  measured[i] = { WIDE[i], name }
end
expect[#expect + 1] = { "falls", what = "widths at which the flow is not greater than at the one before",
  source = "rises with width", band = { 0, 0 } }

return claim {
  id = "O12", title = "ISO 12: how wide a stair is",
  source = "ISO 20414:2020, test 12, by notes of an open implementation",
  text = "A hundred people go up a stair that is 1 to 1.8 m wide. The wider it is, the greater is the flow.",
  level = "normal", held_out = measure.walking_law .. "; the time gap on stairs on a stair of 2 m",
  runs = runs, quick = quick,
  null = { text = "all stairs 1.4 m wide", set = stair_of(1.4) },
  measure = function(run)
    local out, flows = { falls = 0 }, {}
    for i = 1, #WIDE do
      local name = string.format("w%03.0f", 100 * WIDE[i])
      flows[i] = run[name].summary.probes.flow.flow
      out[name] = flows[i]
      if i > 1 and flows[i] <= flows[i - 1] then out.falls = out.falls + 1 end
    end
    return out
  end,
  expect = expect,
  plots = { { name = "flow", title = "ISO 12: flow and width of a stair", x = "width (m)", y = "flow (1/s)",
    { "Jostle", figures = measured }, { "0.88 per metre (IMO)", line = { { 1, 0.88 }, { 1.8, 1.584 } } } } },
  pictures = { w100 = { "flow.png" } },
}
