local measure = require "measure"

return claim {
  id = "R12b", title = "RiMEA 12b: how long the opening is",
  source = "RiMEA 4.1.1, test 12b, as implemented by the verification notebooks of JuPedSim",
  text = "150 people go from a room to another by an opening of 1 m, once 0.2 m long, once 5 m. The first room empties slower "
    .. "by the long one.",
  level = "normal", held_out = measure.walking_law,
  runs = { short = { scene = "../rimea-12.yaml", seeds = "101-110" },
    long = { scene = "../rimea-12-long.yaml", seeds = "101-110" } },
  null = { text = "an opening 0.2 m long in both runs", runs = { long = { scene = "../rimea-12.yaml" } } },
  measure = function(run)
    local short, long = run.short.summary.probes.opening.last, run.long.summary.probes.opening.last
    return { longer = long - short, short = short, long = long }
  end,
  expect = {
    { "longer", unit = "s", what = "how much longer the first room takes to empty",
      source = "slower by the long one; 0.05 s ours", band = { 0.05 } },
    { "short", unit = "s", what = "until it is empty, opening 0.2 m long", source = "none", reported = true },
    { "long", unit = "s", what = "the same, 5 m", source = "none", reported = true },
  },
  pictures = { short = { "opening.png" }, long = { "opening.png", "density.png" } },
}
