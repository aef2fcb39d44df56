local SIDE = { red = -1, blue = 1 } -- side of the court on which a group plays, along x
local STEP = 0.051                  -- s: a little more than the longest step here

-- Whether the ball touched the ground in the step before: its centre is no higher than its radius, plus 0.04 m for what
-- may lie under it, plus the height that it bounced since.
local function down(e) return e.body_z < 0.15 + e.body_speed * STEP end

-- Rules for one entry of the log: who = what happened to the player so far, ball = x of the ball, above 0 in the
-- player's own court. Each returns whether the entry keeps the rule.
local rules = {
  -- Only a defender begins to attack, and only a ball that is down in its own court.
  Attack = function(e, ball) return e.from == "Defense" and ball > 0 and down(e) end,
  -- A point: a player who has defended for 0.3 s was hit by a flying ball, or touched by one faster than 1 m/s.
  Hit = function(e, _, who)
    return e.from == "Defense" and e.time - who.since > 0.29
      and (e.time - who.hit < 2 * STEP or e.gap < 0.1 and e.body_speed > 1)
  end,
  -- An attacker has kicked, or the ball is down in the other court; a player who was hit has stood for a second.
  Defense = function(e, ball, who)
    if e.from == "Hit" then return e.time - who.since > 0.99 end
    return e.time - who.kicked < STEP or ball <= 0 and down(e)
  end,
  -- Only an attacker kicks, once, a ball that it touches and that does not lie in the other court.
  kicks = function(e, ball, who) return e.state == "Attack" and who.kicks == 1 and e.gap < 0.05 and ball > -0.11 end,
}

-- Checks the logged game against its rules; players driven by hand (in state Play) are not judged.
local function judge(run)
  local log, players = run.csv("actions"), {}
  local out = { judged = 0, broken = 0, points = 0, missed = 0 }
  for i = 1, log.n do
    local e = {}
    for column, values in pairs(log) do e[column] = column ~= "n" and values[i] or nil end
    local who = players[e.person] or { since = 0, kicked = -1, hit = -1, kicks = 0 }
    players[e.person] = who
    if who.owes and e.time > who.owes + STEP then out.missed, who.owes = out.missed + 1, nil end
    if e.what == "kicks" then who.kicks, who.kicked = who.kicks + 1, e.time end
    local rule = rules[e.what == "enters" and e.state or e.what]
    if e.state ~= "Play" and rule then
      out.judged = out.judged + 1
      if not rule(e, e.body_x * SIDE[e.group], who) then out.broken = out.broken + 1 end
    end
    if e.what == "enters" then
      if e.state == "Hit" then out.points, who.owes = out.points + 1, nil end
      if e.state == "Attack" then who.kicks = 0 end
      who.since = e.time
    elseif e.what == "hit" then
      who.hit = e.time
      -- A hit on a defender has to be a point by the end of the next step.
      if e.state == "Defense" and e.time - who.since > 0.3 then who.owes = e.time end
    end
  end
  out.counted = run.summary.transitions.dodgeball["Defense>Hit"]
  out.kicks = run.summary.events.kicks
  return out
end

return claim {
  id = "5", title = "Dodge-ball: its rules are kept, and players and balls push each other alike",
  source = "Kim et al. 2014, Figs. 9 and 10",
  text = "Two players of 70 kg and a ball of 0.4 kg; two players and 500 balls among four obstacles. Each entry of the "
    .. "log is held against the rules of Fig. 9: attacked is what is down in the own court, by who defends; only "
    .. "who attacks kicks, once, what it touches; the attack ends with the kick or when the ball is down in the "
    .. "other court. A score is ours: a ball that hits who defends is a point, each point follows from a hit, and each "
    .. "such hit is a point. Where both get the same momentum with opposite signs, a collision changes the ball's "
    .. "velocity 175 times as much as the player's; what does not cancel is the error of that ratio. Kicks are "
    .. "meant, and their reaction goes to the ground: they are not among the collisions.",
  level = "normal",
  held_out = "no constant was chosen on what this measures",
  runs = {
    one = { scene = "../dodgeball.yaml", seeds = 1 },
    duel = { scene = "../dodgeball.yaml", seeds = 1, duration = 120,
      set = { ["groups.red.behaviour"] = "../behaviours/dodgeball.lua", ["groups.red.set.court"] = "red_court" } },
    many = { scene = "../dodgeball-500.yaml", seeds = 3 },
    -- Balls that keep bouncing fly more than they lie, so that there are points.
    bouncing = { scene = "../dodgeball-500.yaml", seeds = 3, duration = 30,
      set = { ["bodies.0.restitution"] = 1, ["bodies.0.damping"] = 0 } },
    many_fine = { scene = "../dodgeball-500.yaml", dt = 0.02, seeds = 1, duration = 30 },
  },
  quick = { many = { seeds = 1 }, bouncing = { seeds = 1 } },
  measure = function(run)
    local one, many, fine = run.one.summary, run.many.summary, run.many_fine.summary
    local by_hand, duel, crowd, small = judge(run.one), judge(run.duel), judge(run.many), judge(run.many_fine)
    local bouncing = judge(run.bouncing)
    return {
      judged = by_hand.judged + duel.judged, judged_many = crowd.judged + bouncing.judged,
      broken = by_hand.broken + duel.broken, broken_many = crowd.broken + bouncing.broken, broken_fine = small.broken,
      points = duel.points, points_many = crowd.points, points_bouncing = bouncing.points,
      missed = duel.missed + crowd.missed + small.missed + bouncing.missed,
      score = math.abs(duel.points - duel.counted) + math.abs(crowd.points - crowd.counted)
        + math.abs(bouncing.points - bouncing.counted),
      residual = one.exchange.residual, residual_many = many.exchange.residual, residual_fine = fine.exchange.residual,
      hits = one.exchange.contacts, hits_many = many.exchange.contacts, kicks = duel.kicks, kicks_many = crowd.kicks,
      lost = one.events.bodies_lost + many.events.bodies_lost,
    }
  end,
  expect = {
    { "judged", what = "changes of state and kicks that were judged, one ball", source = "many", band = { 50 } },
    { "judged_many", what = "the same, 500 balls", source = "many", band = { 200 } },
    { "broken", what = "of these against the rules, one ball", source = "0", band = { 0, 0 } },
    { "broken_many", what = "of these against the rules, 500 balls", source = "0", band = { 0, 0 } },
    { "broken_fine", what = "the same, dt 0.02 s", source = "0", band = { 0, 0 } },
    { "missed", what = "hits on who defends that were no point", source = "0", band = { 0, 0 } },
    { "score", what = "points more or fewer than the machine counted", source = "0", band = { 0, 0 } },
    { "points", what = "points, one ball", reported = true },
    { "points_many", what = "points, 500 balls", reported = true },
    { "points_bouncing", what = "points, 500 balls that go on bouncing", source = "many", band = { 10 } },
    { "kicks", what = "kicks, one ball", source = "some", band = { 2 } },
    { "kicks_many", what = "kicks, 500 balls", source = "many", band = { 20 } },
    { "residual", what = "momentum that does not cancel, share of all in collisions, one ball, dt 0.05 s",
      source = "0", band = { 0, 0.01 } },
    { "residual_many", what = "the same, 500 balls", source = "0", band = { 0, 0.01 } },
    { "residual_fine", what = "the same, 500 balls, dt 0.02 s", source = "0", band = { 0, 0.01 } },
    { "hits", what = "collisions that were measured, one ball", source = "some", band = { 1 } },
    { "hits_many", what = "collisions that were measured, 500 balls", source = "many", band = { 100 } },
    { "lost", what = "bodies that fell out of the world", source = "0", band = { 0, 0 } },
  },
  pictures = { one = { "paths.png", "actions.png" }, many = { "paths.png", "actions.png" } },
}
