local measure = require "measure"

local LENGTH = 4 -- m in plan, between the lines of the probes

local function crowd(way)
  return { scene = "../rimea-13-" .. way .. ".yaml", seeds = "101-105", set = { ["groups.people.count"] = 250 } }
end
local function few(way)
  local set = { ["groups.people.count"] = 10 }
  return { scene = "../rimea-13-" .. way .. ".yaml", seeds = "101-110", duration = 60, set = set }
end

return claim {
  id = "S1", title = "A stair of two metres",
  source = "Fruin, Pedestrian planning and design, 1971, Table 3-B and chapter 3; Weidmann 1993; IMO MSC.1/Circ.1533; Guide to "
    .. "Safety at Sports Grounds",
  text = "250 people press on to a stair of 5 x 2 m in plan, with a slope of 30 degrees: as many pass per metre and second as "
    .. "the sources say at most. Ten people, who hardly meet, are as fast as the surveys say of free walking. Speeds are in plan.",
  level = "normal",
  calibrated = "the factors of the time gap on stairs were chosen on these flows, seeds 1 to 6, and the speeds by slope on the "
    .. "speeds of these sources; the rest of the walking law on neither",
  runs = { up = crowd "up", down = crowd "down", few_up = few "up", few_down = few "down" },
  quick = { up = { seeds = 1 }, down = { seeds = 1 }, few_up = { seeds = 3 }, few_down = { seeds = 3 } },
  null = { text = "people walk as slowly on the stair, and keep the time gap of level ground",
    set = { ["walking.stair_gap_up"] = 1, ["walking.stair_gap_down"] = 1 } },
  measure = function(run)
    local function probes(name) return run[name].summary.probes end
    return {
      up = probes("up").flow.specific_flow, down = probes("down").flow.specific_flow,
      density_up = probes("up").stair.density_median, density_down = probes("down").stair.density_median,
      free_up = LENGTH / probes("few_up").timed.mean, free_down = LENGTH / probes("few_down").timed.mean,
    }
  end,
  expect = {
    { "up", unit = "1/(m s)", what = "flow up", source = "0.88 (IMO) to 1.03 (Fruin)", band = { 0.75, 1.19 } },
    { "down", unit = "1/(m s)", what = "flow down", source = "1.1 (IMO; Sports Grounds)", band = { 0.935, 1.265 } },
    { "free_up", unit = "m/s", what = "free speed up", source = "0.53 (Fruin, 30 degrees) to 0.61 (Weidmann)", band = { 0.43, 0.71 } },
    { "free_down", unit = "m/s", what = "free speed down", source = "0.69 (Weidmann) to 0.71 (Fruin, 30 degrees)", band = { 0.53, 0.88 } },
    { "density_up", unit = "1/m²", what = "density on the stair, up", source = "none: 3.6 where Fruin's flow is greatest", reported = true },
    { "density_down", unit = "1/m²", what = "density on the stair, down", source = "none", reported = true },
  },
  pictures = { up = { "density.png" } },
}
