local measure = require "measure"

-- Mean over T = 80, 100, ... 180 s, after both jams have formed, of how many more people have passed with forces.
local function ratio(with, without)
  local sum = 0
  for time = 80, 180, 20 do
    sum = sum + measure.passed(with.csv("second"), time) / measure.passed(without.csv("second"), time)
  end
  return sum / 6
end

local function run(dt, enabled)
  return { scene = "../two-bottlenecks.yaml", dt = dt, set = { ["forces.enabled"] = enabled } }
end

return claim {
  id = "2", title = "Two bottlenecks: pushing resolves arches and jams",
  source = "Kim et al. 2014, Fig. 6",
  text = "A thousand people, ten a second, press through a gap of two widths, then through one of barely one. "
    .. "Without forces "
    .. "arches hold them up; with forces about twice as many get through, at any time step. A step of 0.1 s is cut "
    .. "into two.",
  level = "keen",
  calibrated = "the pressers' push, 50 N for each metre a second, was chosen on its ratio at all time steps",
  runs = {
    with = run(0.05, true), without = run(0.05, false),
    fine = run(0.02, true), fine_without = run(0.02, false),
    finest = run(0.01, true), finest_without = run(0.01, false),
    coarse = run(0.1, true), coarse_without = run(0.1, false),
  },
  quick = {
    fine = { seeds = 1 }, fine_without = { seeds = 1 }, finest = { seeds = 1 }, finest_without = { seeds = 1 },
    coarse = { seeds = 1 }, coarse_without = { seeds = 1 },
  },
  null = { text = "forces off in the runs with forces too", set = { ["forces.enabled"] = false }, seeds = 1 },
  measure = function(run)
    local with, fine = run.with.summary, run.fine.summary
    return {
      ratio = ratio(run.with, run.without), ratio_fine = ratio(run.fine, run.fine_without),
      ratio_finest = ratio(run.finest, run.finest_without), ratio_coarse = ratio(run.coarse, run.coarse_without),
      lapse = with.probes.second.lapse_max, lapse_fine = fine.probes.second.lapse_max,
      lapse_without = run.without.summary.probes.second.lapse_max,
      overlap = with.overlap_p99,
      through = with.probes.second.passages, through_without = run.without.summary.probes.second.passages,
    }
  end,
  expect = {
    { "ratio", what = "through both with forces over without, mean of T = 80 to 180 s, dt 0.05 s",
      source = "about 2", band = { 1.6, 2.5 } },
    { "ratio_fine", what = "the same, dt 0.02 s", source = "about 2", band = { 1.6, 2.5 } },
    { "ratio_finest", what = "the same, dt 0.01 s", source = "about 2", band = { 1.6, 2.5 } },
    { "ratio_coarse", what = "the same, dt 0.1 s", source = "about 2", band = { 1.6, 2.5 } },
    { "lapse", unit = "s", what = "longest time that nobody came through, with forces", source = "<= 5",
      band = { 0, 5 } },
    { "lapse_fine", unit = "s", what = "the same, dt 0.02 s", source = "<= 5", band = { 0, 5 } },
    { "overlap", what = "99th percentile of overlap, share of a diameter", source = "-", band = { 0, 0.25 } },
    { "lapse_without", unit = "s", what = "longest time that nobody came through, without forces", reported = true },
    { "through", what = "people through both in 180 s, with forces", reported = true },
    { "through_without", what = "the same without forces", reported = true },
  },
  pictures = { with = { "density.png", "second.png" }, without = { "density.png", "second.png" } },
}
