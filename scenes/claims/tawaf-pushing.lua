local measure = require "measure"

return claim {
  id = "8", title = "The Tawaf: who pushes more gets on faster, and so does everybody",
  source = "Kim et al. 2014, Fig. 15",
  text = "Two readings of \"pushing more\": those in the queue and those who leave push harder by 160 N per m/s; and "
    .. "those who circle below their wanted speed push as well. The ground takes the reaction, nobody's prayer ends by "
    .. "a push, seeds are those of the run without. The band is for the second; the first is reported.",
  calibrated = measure.tawaf,
  runs = {
    queue = { scene = "../tawaf-pushing.yaml", seeds = 1, first = true,
      set = { ["groups.pilgrims.memory.press"] = 0, ["heatmap.from"] = 300, ["probes.fields.from"] = 300 } },
    tawaf = { scene = "../tawaf.yaml", seeds = 3, first = true,
      set = { ["heatmap.from"] = 300, ["probes.fields.from"] = 300 } },
    pushing = { scene = "../tawaf-pushing.yaml", seeds = 3, first = true,
      set = { ["heatmap.from"] = 300, ["probes.fields.from"] = 300 } },
  },
  quick = false,
  measure = function(run)
    local before = run.tawaf.summary.regions
    local function gains(after)
      local sum, least = 0, math.huge
      for i = 1, 7 do
        local gain = after["R" .. i] / before["R" .. i] - 1
        sum, least = sum + gain / 7, math.min(least, gain)
      end
      return sum, least
    end
    local gain, least = gains(run.pushing.summary.regions)
    local queue_gain, queue_least = gains(run.queue.summary.regions)
    return { gain = gain, least = least, queue_gain = queue_gain, queue_least = queue_least,
      density = run.pushing.summary.probes.fields.density_max }
  end,
  expect = {
    { "queue_gain", what = "mean gain of the regions where queue and exit push harder", reported = true },
    { "queue_least", what = "gain of the region that gains least then", reported = true },
    { "gain", what = "mean gain of the regions where slow people who circle push too",
      source = "0.2 to 0.4", band = { 0.15, 0.4 } },
    { "least", what = "gain of the region that gains least", source = "> 0", band = { 0 } },
    { "density", unit = "1/m2", what = "greatest density", reported = true },
  },
  pictures = { pushing = { "regions.png", "density.png" } },
}
