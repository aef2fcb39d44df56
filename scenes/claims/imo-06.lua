local measure = require "measure"

return claim {
  id = "I6", title = "IMO 6: round a corner",
  source = "IMO MSC.1/Circ.1533, test 6, as implemented by the verification notebooks of JuPedSim",
  text = "Twenty people turn left at the corner of a corridor of 2 m. All get round it, and none passes through a wall.",
  level = "calm", held_out = measure.walking_law,
  runs = measure.calm({ corner = { scene = "../rimea-06.yaml", seeds = "101-110" } }, "people"),
  quick = { corner = { seeds = 3 } },
  null = { text = "the corridor's inner corner cut off by half a metre",
    set = { ["walls.0.line.5.0"] = 9.5, ["walls.0.line.5.1"] = 2.5 } },
  measure = function(run)
    local probes = run.corner.summary.probes
    return {
      round = probes.corner.forward,
      walls = measure.crossings(probes, "wall_"),
    }
  end,
  expect = {
    { "round", what = "people who get round the corner", source = "all 20", band = { 20, 20 } },
    { "walls", what = "times that the middle of a person came within 0.1 m of a wall", source = "no wall crossed; 0.1 m ours",
      band = { 0, 0 } },
  },
  pictures = { corner = { "paths.png" } },
}
