local measure = require "measure"

return claim {
  id = "N4.1", title = "NIST 4.1: an exit is lost",
  source = "NIST TN 1822, test 4.1, as implemented by the verification notebooks of JuPedSim",
  text = "The first exit is shut after a second. All leave by the second; who cannot see the first learns of it once it is "
    .. "seen.",
  level = "calm", held_out = measure.walking_law,
  runs = measure.calm({ lost = { scene = "../exit-lost.yaml", seeds = "101-110" } }, "people", "leader"),
  quick = { lost = { seeds = 3 } },
  null = { text = "the first exit is shut only when all have left", set = { ["events.0.at"] = 80 } },
  measure = function(run)
    local probes = run.lost.summary.probes
    return { first = probes.west.forward, second = probes.east.forward, last = probes.east.last }
  end,
  expect = {
    { "first", what = "people at the exit that is shut", source = "nobody", band = { 0, 0 } },
    { "second", what = "people at the other one, of 20", source = "all 20", band = { 20, 20 } },
    { "last", unit = "s", what = "until the last is out", source = "none", reported = true },
  },
  pictures = { lost = { "paths.png" } },
}
