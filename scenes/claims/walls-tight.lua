local tight = { scene = "../wall-tight.yaml", seeds = 3, first = true }

return claim {
  id = "3a", title = "A wall that turns as a whole",
  source = "Kim et al. 2014, Fig. 7a",
  text = "The wall of claim 3 with glue that holds: it is not broken, but moves and turns, and a gap lets people out.",
  level = "keen",
  calibrated = "as claim 3",
  runs = { tight = tight, glued = tight },
  quick = { tight = { seeds = 1 }, glued = { seeds = 1 } },
  null = {
    text = "the glue of claim 3, for the bonds; forces off, for the rest", seeds = 1,
    runs = {
      tight = { set = { ["forces.enabled"] = false } },
      glued = { set = { ["bodies.wall.shape.blocks.bond"] = 80 } },
    },
  },
  measure = function(run)
    local tight_run = run.tight.summary
    return {
      broken = run.glued.summary.bonds.broken, turned = math.abs(tight_run.bonds.turned), moved = tight_run.bonds.moved,
      out = 1200 - tight_run.agents, failures = tight_run.lp_failure_share,
    }
  end,
  expect = {
    { "broken", what = "bonds broken", source = "not broken", band = { 0, 0 } },
    { "turned", unit = "deg", what = "turned by, to either side", source = "turns; 10 is ours", band = { 10 } },
    { "moved", unit = "m", what = "moved by, more than a block", source = "moves; 0.4 is ours", band = { 0.4 } },
    { "out", what = "people of 1200 who got out", source = "escape; 1 is ours", band = { 1 } },
    { "failures", what = "share of linear programs without a solution", reported = true },
  },
  pictures = { tight = { "density.png" } },
}
