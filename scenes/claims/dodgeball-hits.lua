-- Balls that keep bouncing hit more people.
local bouncing = { ["bodies.0.restitution"] = 1, ["bodies.0.damping"] = 0 }

return claim {
  id = "5b", title = "Dodge-ball: players and balls push each other alike",
  source = "Kim et al. 2014, Figs. 9 and 10, and equation 7",
  text = "Players of 70 kg and balls of 0.4 kg. Where both get the same momentum with opposite signs, a ball that hits a "
    .. "player changes its velocity 175 times as much as the player's. Measured at each hit by a fast ball: the change of "
    .. "the ball's velocity in Bullet, and that of the player's. Slow touches are contacts of many steps, in which the "
    .. "player also walks; of these the momentum is measured on both sides, and what does not cancel. Kicks are "
    .. "meant, and their reaction goes to the ground: they are not among the collisions.",
  level = "normal",
  held_out = "no constant was chosen on what this measures",
  runs = {
    duel = { scene = "../dodgeball.yaml", seeds = 10, duration = 325 },
    many = { scene = "../dodgeball-500.yaml", seeds = 3, set = bouncing },
    many_fine = { scene = "../dodgeball-500.yaml", dt = 0.02, seeds = 1, duration = 30, set = bouncing },
  },
  quick = { duel = { seeds = 2 }, many = { seeds = 1 } },
  null = { text = "balls of 0.8 kg in place of 0.4", set = { ["bodies.0.mass"] = 0.8 } },
  measure = function(run)
    local duel, many, fine = run.duel.summary, run.many.summary, run.many_fine.summary
    return {
      ratio = duel.exchange.velocity_ratio, ratio_many = many.exchange.velocity_ratio,
      ratio_fine = fine.exchange.velocity_ratio,
      residual = duel.exchange.residual, residual_many = many.exchange.residual, residual_fine = fine.exchange.residual,
      hits = duel.events.hits, hits_many = many.events.hits,
      contacts = duel.exchange.contacts, contacts_many = many.exchange.contacts,
    }
  end,
  expect = {
    { "ratio", what = "change of the ball's velocity over that of the player's, one ball, dt 0.05 s",
      source = "70 kg / 0.4 kg = 175", band = { 173.25, 176.75 } },
    { "ratio_many", what = "the same, 500 balls", source = "175", band = { 173.25, 176.75 } },
    { "ratio_fine", what = "the same, 500 balls, dt 0.02 s", source = "175", band = { 173.25, 176.75 } },
    { "residual", what = "momentum that does not cancel, share of all in collisions, one ball, dt 0.05 s",
      source = "0", band = { 0, 1e-5 } },
    { "residual_many", what = "the same, 500 balls", source = "0", band = { 0, 1e-5 } },
    { "residual_fine", what = "the same, 500 balls, dt 0.02 s", source = "0", band = { 0, 1e-5 } },
    { "hits", what = "hits by fast balls that were measured, one ball", source = "ours", band = { 10 } },
    { "hits_many", what = "the same, 500 balls", source = "ours", band = { 10 } },
    { "contacts", what = "all collisions that were measured, one ball", reported = true },
    { "contacts_many", what = "the same, 500 balls", reported = true },
  },
}
