-- What the paper's machine (Fig. 9) allows.
local legal = { ["Defense>Attack"] = true, ["Attack>Defense"] = true }

-- Transitions of a run that were taken, those the machine does not allow, and those that somebody's
-- state at the end does not account for: all begin in Defense.
local function judge(summary)
  local taken, illegal, attacks = 0, 0, 0
  for name, count in pairs(summary.transitions.dodgeball) do
    taken = taken + count
    if not legal[name] then illegal = illegal + count end
    if name == "Defense>Attack" then attacks = attacks + count end
    if name == "Attack>Defense" then attacks = attacks - count end
  end
  return { taken = taken, illegal = illegal, odd = math.abs(attacks - summary.states.dodgeball.Attack) }
end

return claim {
  id = "5", title = "Dodge-ball: players and balls change each other's velocity by the ratio of their masses",
  source = "Kim et al. 2014, Figs. 9 and 10",
  text = "Two players of 70 kg and a ball of 0.4 kg; two players and 500 balls among four obstacles. Where both get "
    .. "the same momentum with opposite signs, a collision changes the ball's velocity 175 times as much as the "
    .. "player's; what does not cancel is the error of that ratio. Kicks are meant, and their reaction goes to the "
    .. "ground: they are not among the collisions.",
  runs = {
    one = { scene = "../dodgeball.yaml", seeds = 1 },
    many = { scene = "../dodgeball-500.yaml", seeds = 2 },
    many_fine = { scene = "../dodgeball-500.yaml", dt = 0.02, seeds = 1, duration = 30 },
  },
  quick = { many = { seeds = 1, duration = 30 } },
  measure = function(run)
    local one, many, fine = run.one.summary, run.many.summary, run.many_fine.summary
    local played, played_many = judge(one), judge(many)
    return {
      taken = played.taken, taken_many = played_many.taken, illegal = played.illegal + played_many.illegal,
      odd = played.odd + played_many.odd,
      residual = one.exchange.residual, residual_many = many.exchange.residual, residual_fine = fine.exchange.residual,
      hits = one.exchange.contacts, hits_many = many.exchange.contacts, kicks = one.events.kicks,
      kicks_many = many.events.kicks,
      lost = one.events.bodies_lost + many.events.bodies_lost,
    }
  end,
  expect = {
    { "residual", what = "momentum that does not cancel, share of all in collisions, one ball, dt 0.05 s",
      source = "0", band = { 0, 0.01 } },
    { "residual_many", what = "the same, 500 balls", source = "0", band = { 0, 0.01 } },
    { "residual_fine", what = "the same, 500 balls, dt 0.02 s", source = "0", band = { 0, 0.01 } },
    { "hits", what = "collisions that were measured, one ball", source = "some", band = { 1 } },
    { "hits_many", what = "collisions that were measured, 500 balls", source = "many", band = { 100 } },
    { "kicks", what = "kicks, one ball", source = "some", band = { 2 } },
    { "kicks_many", what = "kicks, 500 balls", source = "many", band = { 20 } },
    { "taken", what = "transitions that were taken, one ball", source = "some", band = { 4 } },
    { "taken_many", what = "transitions that were taken, 500 balls", source = "many", band = { 20 } },
    { "illegal", what = "transitions that the machine of Fig. 9 does not have", source = "0", band = { 0, 0 } },
    { "odd", what = "transitions that the states at the end do not account for", source = "0", band = { 0, 0 } },
    { "lost", what = "bodies that fell out of the world", source = "0", band = { 0, 0 } },
  },
  pictures = { one = { "paths.png" }, many = { "paths.png" } },
}
