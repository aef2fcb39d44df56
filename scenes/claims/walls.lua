local breaking = { scene = "../wall-breaking.yaml", seeds = 3, first = true }

return claim {
  id = "3", title = "A wall that breaks",
  source = "Kim et al. 2014, Fig. 2",
  text = "1200 people stop before a wall of 200 glued blocks, press, and carry its pieces away.",
  level = "keen",
  calibrated = "the throng's push, 80 N for each metre a second, and how long it waits, were chosen on all figures of "
    .. "claims 3, 3a and 3b, and so were the mass of the blocks and the strength of their bonds",
  runs = { approach = breaking, breaking = breaking },
  quick = { approach = { duration = 60 }, breaking = { duration = 60 } },
  null = {
    text = "people who see 0.3 m, for the front row; forces off, for the rest", seeds = 1,
    runs = {
      approach = { set = { ["groups.people.set.perception"] = 0.3 } },
      breaking = { set = { ["forces.enabled"] = false } },
    },
  },
  measure = function(run)
    local bonds = run.breaking.summary.bonds
    return {
      front = run.approach.summary.bonds.front_speed, rows = bonds.rows_pressing, pieces = bonds.pieces,
      out = 1200 - run.breaking.summary.agents, failures = run.breaking.summary.lp_failure_share,
    }
  end,
  expect = {
    { "front", unit = "m/s", what = "mean speed of the front row in the second before it first touches the wall",
      source = "stops; below 0.1 is ours", band = { 0, 0.1 } },
    { "rows", what = "rows that press when the first bond breaks, each at least half as many people as the first",
      source = "the crowd presses; 3 is ours", band = { 3 } },
    { "pieces", what = "pieces in the end", source = "broken", band = { 2 } },
    { "out", what = "people of 1200 who got through", reported = true },
    { "failures", what = "share of linear programs without a solution", reported = true },
  },
  pictures = { breaking = { "density.png" } },
}
