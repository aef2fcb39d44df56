local measure = require "measure"

return claim {
  id = "N3.1", title = "NIST 3.1: assigned exits",
  source = "NIST TN 1822, test 3.1, as implemented by the verification notebooks of JuPedSim",
  text = "23 people in twelve rooms on a corridor: each leaves by the exit that was assigned.",
  level = "calm", held_out = measure.walking_law,
  runs = measure.calm({ rooms = { scene = "../rimea-10.yaml", seeds = "101-110" } }, "to_main", "to_secondary"),
  quick = { rooms = { seeds = 3 } },
  null = { text = "everybody assigned to the main exit", set = { ["groups.to_secondary.set.goal"] = "main" } },
  measure = function(run)
    local probes = run.rooms.summary.probes
    return { main = probes.main_right.forward, secondary = probes.secondary_right.forward,
      wrong = probes.main_wrong.passages + probes.secondary_wrong.passages }
  end,
  expect = {
    { "main", what = "people who leave by the main exit", source = "all 15", band = { 15, 15 } },
    { "secondary", what = "people who leave by the secondary exit", source = "all 8", band = { 8, 8 } },
    { "wrong", what = "people at the other exit", source = "nobody", band = { 0, 0 } },
  },
  pictures = { rooms = { "paths.png" } },
}
