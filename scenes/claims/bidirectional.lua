return claim {
  id = "L1", title = "Lanes of people who walk against each other",
  source = "Juelich archive, bidirectional corridor of 4 m at 1.25 people per square metre",
  text = "Fifty people each way. Lanes form by themselves, and nearly keep the speed of free walkers, "
    .. "however people stand at first: in rows along their way or across it.",
  runs = {
    along = { scene = "../bidirectional.yaml", seeds = 6 },
    across = { scene = "../bidirectional-across.yaml", seeds = 6 },
  },
  measure = function(run)
    local along, across = run.along.summary.probes.lanes, run.across.summary.probes.lanes
    return { order = along.order, speed = along.speed, order_across = across.order, speed_across = across.speed }
  end,
  expect = {
    { "order", source = "0.9", band = { 0.9, 1 },
      what = "order parameter of lanes in rows of 0.4 m (1: each row has one way; chance: 0.1), rows along" },
    { "speed", unit = "m/s", what = "mean speed, rows along", source = "1.0", band = { 0.75, 1.25 } },
    { "order_across", what = "order parameter, rows across", source = "0.9", band = { 0.9, 1 } },
    { "speed_across", unit = "m/s", what = "mean speed, rows across", source = "1.0", band = { 0.75, 1.25 } },
  },
  pictures = { along = { "lanes.png", "paths.png" }, across = { "lanes.png", "paths.png" } },
}
