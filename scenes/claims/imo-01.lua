local measure = require "measure"

return claim {
  id = "I1", title = "IMO 1: keeping a speed along a corridor",
  source = "IMO MSC.1/Circ.1533, test 1, as implemented by the verification notebooks of JuPedSim",
  text = "One person walks 40 m along a corridor of 2 m at 1 m/s. That takes 40 s, within 5 %.",
  level = "calm", held_out = measure.walking_law,
  runs = measure.calm({
    walk = { scene = "../rimea-01.yaml", seeds = 1, duration = 60, set = { ["groups.person.set.speed"] = 1 } },
  }, "person"),
  null = { text = "a person who is a tenth slower, at 0.9 m/s", set = { ["groups.person.set.speed"] = 0.9 } },
  measure = function(run) return { time = run.walk.summary.probes.corridor.mean } end,
  expect = { { "time", unit = "s", what = "time for 40 m", source = "40, within 5 %", band = { 38, 42 } } },
  pictures = { walk = { "paths.png" } },
}
