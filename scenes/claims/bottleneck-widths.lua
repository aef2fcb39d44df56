local measure = require "measure"

local widths = { 0.9, 1.0, 1.2, 1.4, 1.6, 1.8, 2.0, 2.2, 2.5 }

local function law(b) return 1.92 * b - 0.07 end
local function name(b) return string.format("b%03.0f", 100 * b) end

-- The same scene with another width of the bottleneck, m.
local function run(b)
  local half = b / 2
  return { scene = "../bottleneck.yaml", seeds = 3, set = {
    ["places.door.line.0.1"] = half, ["places.door.line.1.1"] = -half,
    ["walls.0.line.2.1"] = half, ["walls.0.line.3.1"] = half,
    ["walls.1.line.2.1"] = -half, ["walls.1.line.3.1"] = -half,
  } }
end

local runs, quick, expect, measured = {}, {}, {}, {}
for i = 1, #widths do
  local b = widths[i]
  runs[name(b)] = run(b)
  quick[name(b)] = { seeds = 1 }
  expect[i] = { name(b), unit = "1/s", what = string.format("people through %.1f m per second, the middle 60 %%", b),
    source = string.format("%.2f", law(b)), band = { 0.8 * law(b), 1.2 * law(b) } }
  measured[i] = { b, name(b) }
end
expect[#expect + 1] = { "rms", what = "deviation from the line, root of the mean square over the widths",
  source = "0.13 1/s", band = { 0, 0.12 } }

return claim {
  id = "B2", title = "Flow through bottlenecks, 0.9 to 2.5 m wide",
  source = "Seyfried et al. 2009, doi 10.1287/trsc.1090.0263; Kretz et al. 2006; Liddle et al. 2009: J = 1.92 b - 0.07",
  text = "180 people leave a room through a bottleneck 4 m long. The flow grows with the width in a straight line, "
    .. "not by lanes.",
  runs = runs, quick = quick,
  measure = function(run)
    local out, flows, laws = {}, {}, {}
    for i = 1, #widths do
      flows[i], laws[i] = run[name(widths[i])].summary.probes.door.flow, law(widths[i])
      out[name(widths[i])] = flows[i]
    end
    out.rms = measure.rms(flows, laws)
    return out
  end,
  expect = expect,
  plots = { { name = "flow", title = "Flow through bottlenecks", x = "width (m)", y = "flow (1/s)",
    { "Jostle", figures = measured }, { "1.92 b - 0.07", line = { { 0.9, law(0.9) }, { 2.5, law(2.5) } } } } },
  pictures = { b090 = { "paths.png", "door.png" }, b250 = { "paths.png" } },
}
