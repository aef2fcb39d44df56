local measure = require "measure"
local about = measure.about

return claim {
  id = "L1", title = "Lanes of people who walk against each other",
  source = "Juelich archive, bidirectional corridor of 4 m at 1.25 people per square metre",
  text = "Fifty people each way, among each other at the start. Lanes form by themselves, and nearly keep the speed of "
    .. "free walkers. The source gives no order: two recordings of the archive in corridors 3.6 m wide have 0.93 at 1.8 "
    .. "and 0.51 at 2.3 people per square metre (bo-360-160-160, bot-360-250-250; over 8 m). Lanes alone do not tell the "
    .. "walking law from ORCA, which makes them too, at 1.3 m/s.",
  level = "calm", calibrated = measure.walking_law,
  runs = { both = { scene = "../bidirectional.yaml", seeds = "101-110" } },
  quick = { both = { seeds = 2 } },
  null = { text = "nobody leaves their course for others: turn_cost is 5, not 0.48", seeds = 1,
    set = { ["walking.turn_cost"] = 5 } },
  measure = function(run)
    local lanes = run.both.summary.probes.lanes
    return { order = lanes.order, speed = lanes.speed }
  end,
  expect = {
    { "order", source = "ours: 0.9 or more", band = { 0.9, 1 },
      what = "order parameter of lanes in rows of 0.4 m (1: each row has one way; chance: 0.1)" },
    { "speed", unit = "m/s", what = "mean speed", source = "1.0", band = about(1, 0.25) },
  },
  pictures = { both = { "lanes.png", "paths.png" } },
}
