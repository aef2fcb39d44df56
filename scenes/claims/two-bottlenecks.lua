local measure = require "measure"

-- Mean over T = 80, 100, ... 180 s, after both jams have formed, of how many times more people have passed.
local function ratio(more, fewer)
  local sum = 0
  for time = 80, 180, 20 do
    sum = sum + measure.passed(more.csv("second"), time) / math.max(1, measure.passed(fewer.csv("second"), time))
  end
  return sum / 6
end

local function run(dt, set, seeds) return { scene = "../two-bottlenecks.yaml", dt = dt, set = set, seeds = seeds } end
local function push(newtons, dt) return run(dt or 0.05, { ["groups.people.set.push"] = newtons }) end
local function discs(set)
  set["groups.people.set.breadth"], set["groups.people.set.depth"] = 0.4, 0.4
  return run(0.05, set)
end

return claim {
  id = "2", title = "Two bottlenecks: pushing resolves arches and jams",
  source = "Kim et al. 2014, Fig. 6",
  text = "A thousand people, ten a second, press through a gap of two widths, then through one of barely one. "
    .. "Where people push, about twice as many get through as where they do not, at any time step. Both runs have "
    .. "contacts, and in both people have torsos that turn, so that the ratio is that of pushing alone. Torsos are a "
    .. "rule of ours: discs wedge in the narrow gap, and pushing helps them no more than it helps by the equations as "
    .. "printed. A step of 0.1 s is cut into two of 0.05 s, so it is not run.",
  level = "keen",
  calibrated = "the pressers' push, 50 N for each metre a second, was chosen on the ratio of people through with "
    .. "forces to that without, at all time steps",
  runs = {
    with = push(50), still = push(0),
    fine = push(50, 0.02), fine_still = push(0, 0.02),
    finest = push(50, 0.01), finest_still = push(0, 0.01),
    without = run(0.05, { ["forces.enabled"] = false }),
    round = discs({}),
    round_still = discs({ ["groups.people.set.push"] = 0 }),
    literal = run(0.05, { ["forces.mode"] = "literal" }),
    literal_still = run(0.05, { ["forces.mode"] = "literal", ["groups.people.set.push"] = 0 }),
  },
  quick = {
    fine = { seeds = 1 }, fine_still = { seeds = 1 }, finest = { seeds = 1 }, finest_still = { seeds = 1 },
    without = { seeds = 1 }, round = { seeds = 1 }, round_still = { seeds = 1 }, literal = { seeds = 1 },
    literal_still = { seeds = 1 },
  },
  null = { text = "nobody pushes in the runs with pushing too", seeds = 1, runs = {
    with = { set = { ["groups.people.set.push"] = 0 } }, fine = { set = { ["groups.people.set.push"] = 0 } },
    finest = { set = { ["groups.people.set.push"] = 0 } } } },
  measure = function(run)
    local function through(name) return run[name].summary.probes.second.passages end
    local with, fine = run.with.summary, run.fine.summary
    return {
      ratio = ratio(run.with, run.still), ratio_fine = ratio(run.fine, run.fine_still),
      ratio_finest = ratio(run.finest, run.finest_still),
      lapse = with.probes.second.lapse_max, lapse_fine = fine.probes.second.lapse_max,
      lapse_still = run.still.summary.probes.second.lapse_max,
      overlap = with.overlap_p99, failing = with.probes.solved.share,
      through = through("with"), through_still = through("still"), through_without = through("without"),
      through_round = through("round"), through_round_still = through("round_still"),
      through_literal = through("literal"), through_literal_still = through("literal_still"),
    }
  end,
  expect = {
    { "ratio", what = "through both with pushing over without, mean of T = 80 to 180 s, dt 0.05 s",
      source = "about 2; band ours", band = { 1.6, 2.5 } },
    { "ratio_fine", what = "the same, dt 0.02 s", source = "about 2; band ours", band = { 1.6, 2.5 } },
    { "ratio_finest", what = "the same, dt 0.01 s", source = "about 2; band ours", band = { 1.6, 2.5 } },
    { "lapse", unit = "s", what = "longest time that nobody came through, with pushing",
      source = "jams resolve; band ours", band = { 0, 5 } },
    { "lapse_fine", unit = "s", what = "the same, dt 0.02 s", source = "band ours", band = { 0, 5 } },
    { "overlap", what = "99th percentile of overlap, share of a depth", source = "band ours", band = { 0, 0.25 } },
    { "lapse_still", unit = "s", what = "longest time that nobody came through, without pushing", reported = true },
    { "failing", what = "share of agent-steps whose linear program has no solution", reported = true },
    { "through", what = "people through both in 180 s, with pushing", reported = true },
    { "through_still", what = "without pushing", reported = true },
    { "through_without", what = "without any force", reported = true },
    { "through_round", what = "with pushing, all discs of 0.4 m", reported = true },
    { "through_round_still", what = "without pushing, all discs of 0.4 m", reported = true },
    { "through_literal", what = "with pushing, by the equations as printed", reported = true },
    { "through_literal_still", what = "without pushing, by the equations as printed", reported = true },
  },
  tried = { "pushing by itself gives 1.9 times as many people at T = 180 s, but less before; with discs, and by the "
    .. "equations as printed, it gives nothing at this gap: discs of 0.4 m wedge in 0.5 m" },
  pictures = { with = { "density.png", "second.png" }, still = { "density.png", "second.png" } },
}
