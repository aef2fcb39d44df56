local measure = require "measure"

-- The band of speeds, m/s, over the density on the stair, per m2, that JuPedSim's test of this name has.
local BANDS = {
  up = function(d)
    local fast, slow = 0.18 * d * d - 0.55 * d + 1.02, 0.01 * d + 0.48
    local of_fast, of_slow = math.max(0.35 - 0.14 * d, 0), math.max(0.10 - 0.02 * d, 0)
    return math.min(fast - of_fast, slow - of_slow), math.max(fast + of_fast, slow + of_slow)
  end,
  down = function(d)
    local fast, slow = 0.33 * d * d - 1.02 * d + 1.39, 0.67 - 0.08 * d
    local of_fast, of_slow = math.max(0.29 - 0.11 * d, 0), math.max(0.14 - 0.06 * d, 0)
    return math.min(fast - of_fast, slow - of_slow), math.max(fast + of_fast, slow + of_slow)
  end,
}

-- Share of the seconds with people on the stair, at most at the density `most`, in which their speed is in the band, and
-- their mean speed, m/s.
local function compare(points, band, most)
  local inside, count, sum = 0, 0, 0
  for i = 1, points.n do
    local density, speed = points.density[i], points.speed[i]
    if density > 0.1 and density <= most and speed == speed then
      local low, high = band(density)
      count, sum = count + 1, sum + speed
      if speed >= low and speed <= high then inside = inside + 1 end
    end
  end
  return inside / count, sum / count
end

return claim {
  id = "R13", title = "RiMEA 13: speed over density on a stair",
  source = "RiMEA 4.1.1, test 13, as implemented by the verification notebooks of JuPedSim",
  text = "A hundred people leave a room by a way of 2 m and a stair of 5 x 2 m in plan, up or down. In at least half of the "
    .. "seconds their mean speed in plan is in a band over the density on the stair; down they are faster than up.",
  level = "normal", held_out = measure.walking_law .. "; the two time gaps on stairs on the flow of this set-up, by other seeds",
  runs = { up = { scene = "../rimea-13-up.yaml", seeds = "101-110" }, down = { scene = "../rimea-13-down.yaml", seeds = "101-110" } },
  quick = { up = { seeds = 1 }, down = { seeds = 1 } },
  null = { text = "people who are as fast on stairs as on level ground, 1.34 m/s in plan, and keep no longer time gap", set = {
    ["groups.people.set.stair_up"] = 1.547, ["groups.people.set.stair_down"] = 1.547,
    ["walking.stair_gap_up"] = 1, ["walking.stair_gap_down"] = 1 } },
  measure = function(run)
    local out = {}
    for way, band in pairs(BANDS) do
      local points = run[way].csv("stair")
      out[way], out["speed_" .. way] = compare(points, band, math.huge)
      out["loose_" .. way] = compare(points, band, 2)
    end
    out.faster = out.speed_down / out.speed_up
    return out
  end,
  expect = {
    { "up", what = "share of seconds in the band, up", source = "at least 0.5", band = { 0.5 } },
    { "down", what = "share of seconds in the band, down", source = "at least 0.5", band = { 0.5 } },
    { "faster", what = "mean speed down over that up", source = "above 1", band = { 1 } },
    { "loose_up", what = "share of seconds in the band up to 2 per m², up", source = "none", reported = true },
    { "loose_down", what = "share of seconds in the band up to 2 per m², down", source = "none", reported = true },
    { "speed_up", unit = "m/s", what = "mean speed in plan, up", source = "none", reported = true },
    { "speed_down", unit = "m/s", what = "mean speed in plan, down", source = "none", reported = true },
  },
  tried = { "Above 2 per m² the band, a square of the density, rises: at 2.8 per m² it asks for 0.46 to 0.89 m/s up, a flow of "
    .. "1.3 to 2.5 per m and s, where Fruin has 1.03 at most, IMO 0.88 and the Guide to Safety at Sports Grounds 1.1. People "
    .. "here pass as many as these say (claim S1). With the time gap of level ground it is 0.42 m/s at that density." },
  pictures = { up = { "stair.png" }, down = { "stair.png" } },
}
