return claim {
  id = "3b", title = "A wall that hardly moves",
  source = "Kim et al. 2014, Fig. 7b",
  text = "The wall of claim 3, too heavy for the 1200 people, who all press in the end. Behind it Jostle's people are "
    .. "far too dense: 13 per m2, where the densest crowd recorded had 7.5.",
  level = "keen",
  calibrated = "as claim 3",
  runs = { heavy = { scene = "../wall-heavy.yaml", seeds = 3, first = true } },
  quick = { heavy = { duration = 90 } },
  null = {
    text = "the mass and the glue of claim 3", seeds = 1,
    set = { ["bodies.wall.shape.blocks.block_mass"] = 3, ["bodies.wall.shape.blocks.bond"] = 80 },
  },
  measure = function(run)
    local summary = run.heavy.summary
    return {
      broken = summary.bonds.broken, moved = summary.bonds.moved, density = summary.density_max,
      failures = summary.lp_failure_share,
    }
  end,
  expect = {
    { "broken", what = "bonds broken", source = "not broken", band = { 0, 0 } },
    { "moved", unit = "m", what = "moved by, less than a block", source = "hardly; 0.4 is ours", band = { 0, 0.4 } },
    { "density", unit = "1/m2", what = "greatest density", reported = true },
    { "failures", what = "share of linear programs without a solution", reported = true },
  },
  pictures = { heavy = { "density.png" } },
}
