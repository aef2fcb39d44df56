local measure = require "measure"

-- Density along the ring, 1/m, and mean speed there, m/s.
local points = {
  { 0.55, 0.99 }, { 0.71, 0.90 }, { 0.87, 0.85 }, { 1.11, 0.58 }, { 1.28, 0.42 },
  { 1.49, 0.29 }, { 1.71, 0.22 }, { 1.92, 0.15 }, { 2.09, 0.10 },
}
local length = 26.84 -- m, round the ring
local sway = 0.08    -- m/s: difference between slow speeds measured at the head and along the way

local runs, quick, expect, measured = {}, {}, {}, {}
for i = 1, #points do
  local density, speed, name = points[i][1], points[i][2], string.format("d%03.0f", 100 * points[i][1])
  local off = math.max(0.25 * speed, i == #points and sway / 2 or sway)
  runs[name] = { scene = "../single-file.yaml", seeds = "101-110",
    set = { ["groups.people.count"] = math.floor(density * length + 0.5) } }
  quick[name] = { seeds = 1 }
  expect[i] = { name, unit = "m/s", what = string.format("mean speed at %.2f people per metre", density),
    source = string.format("%.2f", speed), band = { speed - off, speed + off } }
  measured[i] = { density, name }
end
expect[#expect + 1] = { "spread", unit = "m/s", source = "0.063", band = { 0.0315, 0.126 },
  what = "deviation of people's speeds at 2.09 people per metre, within a factor of two" }
expect[#expect + 1] = { "standing", source = "0.07 to 0.09", band = { 0.035, 0.18 },
  what = "share of people and time slower than 0.05 m/s there, within a factor of two" }
expect[#expect + 1] = { "spread_119", unit = "m/s", source = "0.078", reported = true,
  what = "deviation of people's speeds at 1.19 people per metre (34 people, one camera)" }
expect[#expect + 1] = { "standing_119", source = "0", reported = true, what = "share of those who stand there" }

runs.d119 = { scene = "../single-file.yaml", seeds = "101-110", set = { ["groups.people.count"] = 32 } }
quick.d119 = { seeds = 1 }

return claim {
  id = "F1", title = "Speed and density in single file",
  source = "Seyfried et al. 2005, doi 10.1088/1742-5468/2005/10/P10002, and later sets of the Juelich archive",
  text = "People one behind the other in a ring of 26.84 m: the more, the slower, by the way ahead that each has. Sources "
    .. "follow heads, whose sway adds to slow speeds: in a set of 56 people 0.219 m/s of the head are 0.141 m/s along the "
    .. "way. Bands are a quarter to either side, but no narrower than that difference, "
    .. "and half of it at 2.09 people per metre.",
  level = "calm", calibrated = measure.walking_law,
  runs = runs, quick = quick, null = measure.half_gap(),
  measure = function(run)
    local out = {}
    for name in pairs(runs) do out[name] = run[name].summary.probes.ring.speed end
    local dense, n34 = run.d209.summary.probes.ring, run.d119.summary.probes.ring
    out.spread, out.standing = dense.speed_deviation, dense.standing
    out.spread_119, out.standing_119 = n34.speed_deviation, n34.standing
    return out
  end,
  expect = expect,
  plots = { { name = "diagram", title = "Single file: speed and density", x = "density (1/m)", y = "mean speed (m/s)",
    { "Jostle", figures = measured }, { "measured by others", points = points } } },
  pictures = { d055 = { "ring.png" }, d171 = { "ring.png" } },
}
