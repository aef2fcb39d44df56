local measure = require "measure"

-- 10 %, 50 % and 90 % values of speed, m/s, by density along the way, 1/m.
local ENVELOPE = {
  { 0.3, 0.840, 1.160, 1.473 }, { 0.5, 0.708, 1.091, 1.389 }, { 0.7, 0.598, 0.975, 1.305 }, { 0.9, 0.448, 0.747, 1.101 },
  { 1.1, 0.316, 0.520, 0.840 }, { 1.3, 0.187, 0.393, 0.608 }, { 1.5, 0.112, 0.273, 0.485 }, { 1.7, 0.071, 0.199, 0.382 },
  { 1.9, 0.048, 0.158, 0.314 }, { 2.1, 0.035, 0.131, 0.270 },
}
local LENGTH = 26.84 -- m, round the ring
local function name_of(density) return string.format("d%03.0f", 100 * density) end

local runs, fewer, quick, expect, measured, low, middle, high = {}, {}, {}, {}, {}, {}, {}, {}
for i = 1, #ENVELOPE do
  local e = ENVELOPE[i]
  local name = name_of(e[1])
  runs[name] = { scene = "../single-file.yaml", seeds = "101-110", duration = 150, set = {
    ["groups.people.count"] = math.floor(e[1] * LENGTH + 0.5), ["groups.people.set.haste"] = "calm",
    ["groups.people.set.speed"] = "normal(1.34, 0.26, 0.6, 2.2)" } }
  fewer[name] = { set = { ["groups.people.count"] = math.floor(e[1] * LENGTH / 1.5 + 0.5) } }
  quick[name] = { seeds = 1 }
  expect[i] = { name, unit = "m/s", what = string.format("mean speed at %g people per metre", e[1]), reported = true,
    source = string.format("%.3f to %.3f", e[2], e[4]) }
  measured[i], low[i], middle[i], high[i] = { e[1], name }, { e[1], e[2] }, { e[1], e[3] }, { e[1], e[4] }
end
expect[#expect + 1] = { "inside", what = "share of densities at which the mean speed lies within the envelope",
  source = "0.75 or more", band = { 0.75, 1 } }

return claim {
  id = "R16", title = "RiMEA 16: one behind the other",
  source = "RiMEA 4.1.1, test 16, as implemented by the verification notebooks of JuPedSim",
  text = "People walk one behind the other round a ring. At each density their speed lies between those of the slowest and of "
    .. "the fastest tenth that experiments found, for three densities of four.",
  level = "calm", held_out = measure.walking_law,
  runs = runs, quick = quick,
  null = { text = "two thirds of the people", runs = fewer },
  measure = function(run)
    local out, inside = {}, 0
    for i = 1, #ENVELOPE do
      local e = ENVELOPE[i]
      local speed = run[name_of(e[1])].summary.probes.ring.speed
      out[name_of(e[1])] = speed
      if speed >= e[2] and speed <= e[4] then inside = inside + 1 end
    end
    out.inside = inside / #ENVELOPE
    return out
  end,
  expect = expect,
  plots = { { name = "diagram", title = "RiMEA 16: speed and density", x = "density (1/m)", y = "mean speed (m/s)",
    { "Jostle", figures = measured }, { "slowest tenth", line = low }, { "half", line = middle }, { "fastest tenth", line = high } } },
  pictures = { d110 = { "ring.png" } },
}
