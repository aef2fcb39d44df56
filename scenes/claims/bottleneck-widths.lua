local measure = require "measure"

-- m; and people, as many as keep the flow up.
local widths = {
  { 0.7, 120 }, { 0.9, 150 }, { 1.2, 180 }, { 1.6, 220 }, { 2.0, 260 }, { 2.5, 300 }, { 3.6, 380 }, { 5.0, 450 },
}

local function law(b) return 1.92 * b - 0.07 end
local function name(b) return string.format("b%03.0f", 100 * b) end

-- The scene with another width of the bottleneck, m, and this number of people at 3.3 per square metre.
local function run(b, people)
  local half, west = b / 2, -2 - people / 3.3 / 7.2
  return { scene = "../bottleneck.yaml", seeds = "101-110", set = {
    ["groups.people.count"] = people,
    ["places.waiting.polygon.0.0"] = west, ["places.waiting.polygon.3.0"] = west,
    ["walls.0.line.2.1"] = half, ["walls.0.line.3.1"] = half,
    ["walls.1.line.2.1"] = -half, ["walls.1.line.3.1"] = -half,
  } }
end

local runs, quick, expect, measured = {}, {}, {}, {}
for i = 1, #widths do
  local b, people = table.unpack(widths[i])
  runs[name(b)], quick[name(b)] = run(b, people), { seeds = 1 }
  expect[i] = measure.expected(name(b), "1/s", string.format("people through %.1f m per second, the middle 60 %%", b),
    law(b), 0.15)
  if b < 0.9 or b > 2.5 then expect[i].source = expect[i].source .. " (extrapolated)" end
  measured[i] = { b, name(b) }
end
expect[#expect + 1] = { "rms", what = "relative deviation from the line, root of the mean square over the widths",
  source = "0.13 1/s, of the flow", reported = true }

return claim {
  id = "B2", title = "Flow through bottlenecks, 0.7 to 5 m wide",
  source = "Seyfried et al. 2009, doi 10.1287/trsc.1090.0263; Kretz et al. 2006; Liddle et al. 2009: J = 1.92 b - 0.07, "
    .. "measured from 0.9 to 2.5 m",
  text = "People leave a room through a bottleneck 4 m long. The flow grows with the width in a straight line, not by lanes.",
  level = "normal", calibrated = measure.walking_law,
  runs = runs, quick = quick, null = measure.by_orca("people"),
  measure = function(run)
    local out, flows, laws = {}, {}, {}
    for i = 1, #widths do
      local b = widths[i][1]
      flows[i], laws[i] = run[name(b)].summary.probes.door.flow, law(b)
      out[name(b)] = flows[i]
    end
    out.rms = measure.rms(flows, laws)
    return out
  end,
  expect = expect,
  plots = { { name = "flow", title = "Flow through bottlenecks", x = "width (m)", y = "flow (1/s)",
    { "Jostle", figures = measured }, { "1.92 b - 0.07", line = { { 0.7, law(0.7) }, { 5, law(5) } } } } },
  pictures = { b090 = { "paths.png", "door.png" }, b250 = { "paths.png" } },
}
