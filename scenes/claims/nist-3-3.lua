local measure = require "measure"

return claim {
  id = "N3.3", title = "NIST 3.3: the exit that people are used to",
  source = "NIST TN 1822, test 3.3, as implemented by the verification notebooks of JuPedSim",
  text = "People who are used to the first of two exits leave by it, though most of them are nearer to the other one.",
  level = "calm", held_out = measure.walking_law,
  runs = measure.calm({
    used = { scene = "../two-exits.yaml", seeds = "101-110", set = { ["places.hall.polygon.0.0"] = 9, ["places.hall.polygon.3.0"] = 9,
      ["groups.people.set.used_to"] = 50, ["groups.leader.set.premovement"] = 60 } },
    new = { scene = "../two-exits.yaml", seeds = "101-110", set = { ["places.hall.polygon.0.0"] = 9, ["places.hall.polygon.3.0"] = 9,
      ["groups.leader.set.premovement"] = 60 } },
  }, "people", "leader"),
  quick = { used = { seeds = 3 }, new = { seeds = 3 } },
  null = { text = "people who are used to neither exit", runs = { used = { set = { ["groups.people.set.used_to"] = 0 } } } },
  measure = function(run)
    return { used = run.used.summary.probes.west.forward, new = run.new.summary.probes.west.forward }
  end,
  expect = {
    { "used", what = "people at the exit that they are used to, of 20", source = "it is preferred; ours: all 20",
      band = { 20, 20 } },
    { "new", what = "people at that exit who are not used to it", source = "ours", band = { 0, 10 } },
  },
  pictures = { used = { "paths.png" } },
}
