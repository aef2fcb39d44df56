return claim {
  id = "4", title = "An office: people and furniture push each other alike",
  source = "Kim et al. 2014, Fig. 8 and equation 7",
  text = "1200 people in 160 s stream through an office, six a second, past 65 pieces of furniture: desks, "
    .. "chairs, shelves and sofas made of convex parts, and stacks of boxes, twelve of which are thrown among them. "
    .. "What people are given by contacts with bodies, bodies are given with the opposite sign: measured in every "
    .. "step, on the people's side as forces, on the other as the change of momentum in Bullet. The stream passes: as "
    .. "many leave as come.",
  level = "normal",
  held_out = "no constant was chosen on what this measures; the scene's rate, six a second, is one that the office "
    .. "lets through without a jam that grows",
  runs = {
    office = { scene = "../office.yaml", seeds = 8 },
    fine = { scene = "../office.yaml", seeds = 1, dt = 0.02, duration = 30 },
  },
  quick = { office = { seeds = 2 }, fine = { duration = 15 } },
  measure = function(run)
    local office, fine = run.office.summary, run.fine.summary
    return {
      residual = office.exchange.residual, residual_fine = fine.exchange.residual,
      contacts = office.exchange.contacts, thrown = office.events.throws, hits = office.events.hits,
      impulse = office.exchange.impulse, lost = office.events.bodies_lost, left = office.events.removed,
      overlap = office.overlap_p99, passed = office.probes.exit.forward / office.probes.entrance.forward,
      back = office.probes.exit.back + office.probes.entrance.back,
    }
  end,
  expect = {
    { "residual", what = "momentum that does not cancel, share of all that is exchanged, dt 0.05 s", source = "0",
      band = { 0, 1e-5 } },
    { "residual_fine", what = "the same, dt 0.02 s", source = "0", band = { 0, 1e-5 } },
    { "contacts", what = "contacts with bodies that were measured", source = "many", band = { 1000 } },
    { "thrown", what = "boxes thrown", source = "12", band = { 12, 12 } },
    { "lost", what = "bodies that fell out of the world", source = "0", band = { 0, 0 } },
    { "passed", what = "people who leave over people who come, in the second half", source = "1", band = { 0.8, 1.2 } },
    { "back", what = "people who go back, at the entrance and the exit", reported = true },
    { "impulse", unit = "N s", what = "momentum exchanged, sum of sizes", reported = true },
    { "hits", what = "people hit by boxes that fly", reported = true },
    { "left", what = "people who got out, of 1200", reported = true },
    { "overlap", what = "99th percentile of overlap, share of a diameter", reported = true },
  },
  pictures = { office = { "density.png", "exit.png" } },
}
