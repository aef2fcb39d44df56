local measure = require "measure"

return claim {
  id = "R12c", title = "RiMEA 12c: two openings, one behind the other",
  source = "RiMEA 4.1.1, test 12c, as implemented by the verification notebooks of JuPedSim",
  text = "150 people go through two openings alike. They jam before the first; before the second hardly, as no more come than "
    .. "it lets through.",
  level = "normal", held_out = measure.walking_law,
  runs = { three = { scene = "../rimea-12-three.yaml", seeds = "101-110" } },
  null = { text = "a second opening of 0.7 m",
    set = { ["walls.3.solid.2.1"] = 4.65, ["walls.3.solid.3.1"] = 4.65, ["walls.4.solid.0.1"] = 5.35,
      ["walls.4.solid.1.1"] = 5.35 } },
  measure = function(run)
    local probes = run.three.summary.probes
    return { first = probes.before_first.density, second = probes.before_second.density,
      ratio = probes.before_first.density / probes.before_second.density,
      flow = probes.opening.flow, flow_second = probes.second.flow, people = probes.second.forward }
  end,
  expect = {
    { "ratio", what = "density before the first opening over that before the second",
      source = "jam before the first alone; 1.2 ours", band = { 1.2 } },
    { "people", what = "people who get through both", source = "all 150", band = { 150, 150 } },
    { "first", unit = "1/m2", what = "density before the first opening, 20 to 70 s", source = "none", reported = true },
    { "second", unit = "1/m2", what = "density before the second opening", source = "none", reported = true },
    { "flow", unit = "1/s", what = "flow through the first", source = "none", reported = true },
    { "flow_second", unit = "1/s", what = "flow through the second", source = "none", reported = true },
  },
  pictures = { three = { "opening.png", "second.png", "density.png" } },
}
