local measure = require "measure"

local alike = { ["groups.slow.set.speed"] = 1.25, ["groups.slow.set.radius"] = 0.2 }

return claim {
  id = "N2.10", title = "NIST 2.10: somebody who is slower and broader",
  source = "NIST TN 1822, test 2.10, as implemented by the verification notebooks of JuPedSim",
  text = "25 people go from a room to another by a corridor of 1.5 m. It takes longer if one of them walks at 0.8 m/s in place "
    .. "of 1.25 and has a radius of 0.4 m.",
  level = "calm", held_out = measure.walking_law,
  runs = measure.calm({
    with = { scene = "../slow-person.yaml", seeds = "101-110" },
    without = { scene = "../slow-person.yaml", seeds = "101-110", set = alike },
  }, "people", "slow"),
  quick = { with = { seeds = 3 }, without = { seeds = 3 } },
  null = { text = "nobody is slower or broader", runs = { with = { set = alike } } },
  measure = function(run)
    local with, without = run.with.summary.probes.through, run.without.summary.probes.through
    return { longer = with.last - without.last, with = with.last, without = without.last,
      people = math.min(with.forward, without.forward) }
  end,
  expect = {
    { "longer", unit = "s", what = "how much longer it takes", source = "longer; 0.05 s ours", band = { 0.05 } },
    { "people", what = "people who get through", source = "all 25", band = { 25, 25 } },
    { "with", unit = "s", what = "until the last is through, with", source = "none", reported = true },
    { "without", unit = "s", what = "the same, without", source = "none", reported = true },
  },
  pictures = { with = { "paths.png" } },
}
