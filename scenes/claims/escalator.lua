local SLOPE = math.cos(math.rad(30))
local LENGTH = 5.5 / SLOPE -- m along the slope, between the lines of the probe

local function ride(speed, more)
  local run = { scene = "../escalator.yaml", seeds = "101-103", set = { ["stairs.escalator.speed"] = speed } }
  for key, value in pairs(more or {}) do run[key] = value end
  return run
end
local few = { duration = 60, set = { ["stairs.escalator.speed"] = 0.61, ["groups.people.count"] = 3, ["groups.people.set.escalator_walk"] = 0 } }
local all_stand = { set = { ["stairs.escalator.speed"] = 0.61, ["groups.people.set.escalator_walk"] = 0 } }

return claim {
  id = "S2", title = "An escalator of one metre",
  source = "Fruin, Pedestrian planning and design, 1971, revised 1987, chapter 5 and Table 5-A (treads of 40 inches)",
  text = "250 people press on to an escalator with treads of one metre and a slope of 30 degrees. At 120 feet per minute, 0.61 m/s, "
    .. "Strakosch observed 90 people a minute on average, and Fruin filmed a boarding every 1.17 s by each of two, 103 a minute, under "
    .. "constant queues; makers reckon with 178. London Transport found 150 a minute at 145 feet per minute, where people walk on one "
    .. "side. Those who stand move as fast as the belt.",
  level = "normal", held_out = "all constants: none was chosen on escalators but the share of people who walk, 0.25",
  runs = { us = ride(0.61), london = ride(0.737), lone = ride(0.61, few), queue = ride(0.61, all_stand) },
  quick = { us = { seeds = 1 }, london = { seeds = 1 }, lone = { seeds = 1 }, queue = { seeds = 1 } },
  null = { text = "a belt that hardly moves, 0.1 m/s, on which people walk", set = { ["stairs.escalator.speed"] = 0.1,
    ["groups.people.set.escalator_walk"] = 1 } },
  measure = function(run)
    local function probes(name) return run[name].summary.probes end
    local function speed(name) return probes(name).timed.mean and LENGTH / probes(name).timed.mean end
    return {
      us = 60 * probes("us").flow.flow, london = 60 * probes("london").flow.flow, lone = speed("lone"), queue = speed("queue"),
      density = probes("us").escalator.density_median,
    }
  end,
  expect = {
    { "us", unit = "1/min", what = "people a minute, 0.61 m/s", source = "90 (Strakosch) to 103 (Fruin)", band = { 76.5, 118.5 } },
    { "london", unit = "1/min", what = "people a minute, 0.737 m/s", source = "150 (London Transport)", band = { 127.5, 172.5 } },
    { "lone", unit = "m/s", what = "speed along the slope of three who stand", source = "0.61, the belt's; ours: 5 %", band = { 0.58, 0.64 } },
    { "queue", unit = "m/s", what = "speed along the slope where all stand, in a queue", source = "0.61, the belt's; ours: 5 %", band = { 0.58, 0.64 } },
    { "density", unit = "1/m²", what = "density on the slope", source = "below 2.7 at 90 a minute: over 4 square feet each", reported = true },
  },
  pictures = { us = { "flow.png" } },
}
