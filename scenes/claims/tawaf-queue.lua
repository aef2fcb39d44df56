return claim {
  id = "9", title = "The queue to the Black Stone moves because it pushes",
  source = "Kim et al. 2014, Fig. 13",
  text = "Those who queue push those in their way, and are served in the order in which they came. Without forces "
    .. "the stream around the Kaaba sweeps the queue away and hardly anybody gets to the stone.",
  runs = {
    queue = { scene = "../tawaf-queue.yaml", seeds = 3 },
    without = { scene = "../tawaf-queue.yaml", seeds = 3, set = { ["forces.enabled"] = false } },
  },
  quick = { queue = { seeds = 1 }, without = { seeds = 1 } },
  measure = function(run)
    local with, without = run.queue.summary.probes.stone, run.without.summary.probes.stone
    return {
      ratio = with.passages / math.max(1, without.passages), touched = with.passages,
      touched_without = without.passages,
      inversions = with.inversions, time = with.median,
    }
  end,
  expect = {
    { "ratio", what = "people who touch the stone, with forces over without (of whom at least one is counted)",
      source = "> 1", band = { 1.5 } },
    { "inversions", what = "share of the pairs in the queue that change order", source = "order kept",
      band = { 0, 0.05 } },
    { "touched", what = "people who touch it, with forces", reported = true },
    { "touched_without", what = "people who touch it, without", reported = true },
    { "time", unit = "s", what = "median time in the queue", reported = true },
  },
  pictures = { queue = { "stone.png" } },
}
