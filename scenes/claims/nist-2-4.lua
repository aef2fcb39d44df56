local measure = require "measure"

-- Times of a hundred people, side by side, for 40 m between two lines.
return claim {
  id = "N2.4", title = "NIST 2.4: speeds that are given",
  source = "NIST TN 1822, test 2.4, as implemented by the verification notebooks of JuPedSim",
  text = "A hundred people have speeds of a normal distribution, 1.2 and 0.2 m/s. Their speeds over 40 m are of it.",
  level = "calm", held_out = measure.walking_law,
  runs = measure.calm({ walk = { scene = "../rimea-07.yaml", seeds = "101-103",
    set = { ["groups.adults.count"] = 98, ["groups.adults.set.speed"] = "normal(1.2, 0.2)" } } }, "adults"),
  quick = { walk = { seeds = 1 } },
  null = { text = "people who are a tenth faster", set = { ["groups.adults.set.speed"] = "normal(1.32, 0.2)" } },
  measure = function(run)
    local transits, speeds = run.walk.csv("adults").transit, {}
    for i = 1, #transits do speeds[i] = 40 / transits[i] end
    return { mean = measure.mean(speeds), deviation = measure.deviation(speeds),
      p = measure.kolmogorov_smirnov(speeds, measure.normal_share(1.2, 0.2)) }
  end,
  expect = {
    { "mean", unit = "m/s", what = "mean speed", source = "1.2; band ours", band = { 1.14, 1.26 } },
    { "deviation", unit = "m/s", what = "standard deviation", source = "0.2; band ours", band = { 0.16, 0.24 } },
    { "p", what = "chance of so great a difference (Kolmogorov and Smirnov)", source = "above 0.05", band = { 0.05, 1 } },
  },
  pictures = { walk = { "adults.png" } },
}
