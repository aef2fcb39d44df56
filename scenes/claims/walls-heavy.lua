return claim {
  id = "3b", title = "A wall that hardly moves",
  source = "Kim et al. 2014, Fig. 7b",
  text = "The wall of claim 3, too heavy for the 1200 people, who all press in the end. Behind it Jostle's people stand as "
    .. "dense as torsos of 0.45 by 0.25 m can, 9.6 per m2, in columns chest to back. Men and women of unequal build stand "
    .. "less densely; the densest crowd recorded had 7.5.",
  level = "keen",
  calibrated = "as claim 3",
  runs = {
    heavy = { scene = "../wall-heavy.yaml", seeds = 3, first = true },
    adults = { scene = "../wall-heavy-adults.yaml", seeds = 3 },
  },
  quick = { heavy = { duration = 90 }, adults = { duration = 90 } },
  null = {
    text = "the mass and the glue of claim 3", seeds = 1,
    set = { ["bodies.wall.shape.blocks.block_mass"] = 3, ["bodies.wall.shape.blocks.bond"] = 80 },
  },
  measure = function(run)
    local summary = run.heavy.summary
    local adults = run.adults.summary
    return {
      density_adults = adults.density_max, depth_adults = 1000 * adults.depth_p99,
      broken = summary.bonds.broken, moved = summary.bonds.moved, density = summary.density_max,
      depth = 1000 * 0.25 * summary.overlap_p99, failures = summary.lp_failure_share,
    }
  end,
  expect = {
    { "broken", what = "bonds broken", source = "not broken", band = { 0, 0 } },
    { "moved", unit = "m", what = "moved by, less than a block", source = "hardly; 0.4 is ours", band = { 0, 0.4 } },
    { "depth", unit = "mm", what = "depth of overlap, 99th percentile, of a torso's 250 mm", source = "ours: at most 20",
      band = { 0, 20 } },
    { "density", unit = "1/m2", what = "greatest density", reported = true },
    { "depth_adults", unit = "mm", what = "depth of overlap of those who touch, 99th percentile, of men and women",
      source = "ours: at most 20", band = { 0, 20 } },
    { "density_adults", unit = "1/m2", what = "greatest density of men and women", source = "7.5 recorded; at most 9 is ours",
      band = { 0, 9 } },
    { "failures", what = "share of linear programs without a solution", reported = true },
  },
  tried = { "friction of 0.3 between people slows the packing and in the end gives the same density, people of unequal size "
    .. "(radius 0.2 m, standard deviation 0.013) 9.6 per m2, a depth of 0.29 m in place of 0.25 8.5 per m2" },
  pictures = { heavy = { "density.png" } },
}
