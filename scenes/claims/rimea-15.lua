local measure = require "measure"

return claim {
  id = "R15", title = "RiMEA 15: the long and the short way round a corner",
  source = "RiMEA 4.1.1, test 15, as implemented by an open social-force suite that quotes it",
  text = "A crowd of 500 goes round the corner of a corridor 20 m wide. It needs longer than along a straight corridor as long "
    .. "as the inner way, 44 m, and less long than along one as long as the outer way, 75.4 m.",
  level = "normal", held_out = measure.walking_law,
  runs = { corner = { scene = "../rimea-15.yaml", seeds = "101-110" },
    straight = { scene = "../rimea-15-straight.yaml", seeds = "101-110" } },
  quick = { corner = { seeds = 1 }, straight = { seeds = 1 } },
  null = { text = "people who walk a fifth faster round the corner", seeds = 1, runs = {
    corner = { set = { ["groups.people.set.speed"] = "normal(1.608, 0.312, 0.72, 2.2)" } } } },
  measure = function(run)
    local corner, straight = run.corner.summary.probes.turned, run.straight.summary.probes
    return {
      over = corner.last - straight.inner.last, under = straight.outer.last - corner.last, corner = corner.last,
      people = math.min(corner.forward, straight.inner.forward, straight.outer.forward),
    }
  end,
  expect = {
    { "over", unit = "s", what = "how much longer than along the inner way, until the last is there",
      source = "longer than 44 m; 0.05 s ours", band = { 0.05 } },
    { "under", unit = "s", what = "how much less long than along the outer way", source = "less long than 75.4 m; 0.05 s ours",
      band = { 0.05 } },
    { "people", what = "people who arrive, of 500", source = "all 500", band = { 500, 500 } },
    { "corner", unit = "s", what = "round the corner, until the last is there", source = "none", reported = true },
  },
  pictures = { corner = { "paths.png" }, straight = { "paths.png" } },
}
