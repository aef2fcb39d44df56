return claim {
  id = "8", title = "The Tawaf: who pushes more gets on faster, and so does everybody",
  source = "Kim et al. 2014, Fig. 15",
  text = "Beside those in the queue, those who leave and those who circle below their wanted speed push as well "
    .. "(160 N per m/s, the ground takes the reaction). Same seeds as without.",
  runs = {
    tawaf = { scene = "../tawaf.yaml", seeds = 3, first = true,
      set = { ["heatmap.from"] = 300, ["probes.fields.from"] = 300 } },
    pushing = { scene = "../tawaf-pushing.yaml", seeds = 3, first = true,
      set = { ["heatmap.from"] = 300, ["probes.fields.from"] = 300 } },
  },
  quick = false,
  measure = function(run)
    local before, after = run.tawaf.summary.regions, run.pushing.summary.regions
    local sum, least = 0, math.huge
    for i = 1, 7 do
      local gain = after["R" .. i] / before["R" .. i] - 1
      sum, least = sum + gain / 7, math.min(least, gain)
    end
    return { gain = sum, least = least, density = run.pushing.summary.probes.fields.density_max }
  end,
  expect = {
    { "gain", what = "mean gain of the regions", source = "0.2 to 0.4", band = { 0.15, 0.4 } },
    { "least", what = "gain of the region that gains least", source = "> 0", band = { 0 } },
    { "density", unit = "1/m2", what = "greatest density", reported = true },
  },
  pictures = { pushing = { "regions.png", "density.png" } },
}
