local measure = require "measure"
local WITHOUT = { ["forces.enabled"] = false }

return claim {
  id = "9", title = "The queue to the Black Stone moves because it pushes",
  source = "Kim et al. 2014, Fig. 13",
  text = "Those who queue push those in their way, and are served in the order in which they came to the queue, from "
    .. "where its time and order count. Without forces the stream around the Kaaba sweeps the queue away and hardly anybody gets to the stone.",
  calibrated = measure.tawaf,
  runs = {
    full = measure.tawaf_run { seeds = 3 },
    full_without = measure.tawaf_run { set = WITHOUT },
    queue = { scene = "../tawaf-queue.yaml", seeds = 3 },
    without = { scene = "../tawaf-queue.yaml", seeds = 3, set = WITHOUT },
  },
  quick = false,
  null = { text = "forces off in the runs with forces too", set = WITHOUT, seeds = 1 },
  measure = function(run)
    local with, without = run.queue.summary.probes.stone, run.without.summary.probes.stone
    local full, alone = run.full.summary.probes.stone, run.full_without.summary.probes.stone
    return {
      full = full.passages / math.max(1, alone.passages), full_touched = full.passages,
      full_alone = alone.passages, full_inversions = full.inversions,
      ratio = with.passages / math.max(1, without.passages), touched = with.passages,
      touched_without = without.passages,
      inversions = with.inversions, time = with.median,
    }
  end,
  expect = {
    { "full", what = "of the 35,000: people who touch the stone, with forces over without (of whom at least one is "
      .. "counted)", source = "> 1; band ours", band = { 1.5 } },
    { "full_inversions", what = "of them: share of the pairs in the queue that change order",
      source = "order kept; band ours", band = { 0, 0.05 } },
    { "full_touched", what = "of the 35,000, people who touch it in the whole run, with forces", reported = true },
    { "full_alone", what = "the same, without", reported = true },
    { "ratio", what = "of the four thousand nearest: people who touch the stone, with forces over without (of whom at "
      .. "least one is counted)",
      source = "> 1; band ours", band = { 1.5 } },
    { "inversions", what = "share of the pairs in the queue that change order", source = "order kept; band ours",
      band = { 0, 0.05 } },
    { "touched", what = "people who touch it, with forces", reported = true },
    { "touched_without", what = "people who touch it, without", reported = true },
    { "time", unit = "s", what = "median time in the queue", reported = true },
  },
  pictures = { queue = { "stone.png" } },
}
