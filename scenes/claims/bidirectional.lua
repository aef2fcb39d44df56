local measure = require "measure"
local about = measure.about

return claim {
  id = "L1", title = "Lanes of people who walk against each other",
  source = "Juelich archive, bidirectional corridor of 4 m at 1.25 people per square metre",
  text = "Fifty people each way, among each other at the start. Lanes form by themselves, and nearly keep the speed of "
    .. "free walkers.",
  level = "calm", calibrated = measure.walking_law,
  runs = { both = { scene = "../bidirectional.yaml", seeds = "101-110" } },
  quick = { both = { seeds = 2 } },
  measure = function(run)
    local lanes = run.both.summary.probes.lanes
    return { order = lanes.order, speed = lanes.speed }
  end,
  expect = {
    { "order", source = "0.9", band = { 0.9, 1 },
      what = "order parameter of lanes in rows of 0.4 m (1: each row has one way; chance: 0.1)" },
    { "speed", unit = "m/s", what = "mean speed", source = "1.0", band = about(1, 0.25) },
  },
  pictures = { both = { "lanes.png", "paths.png" } },
}
