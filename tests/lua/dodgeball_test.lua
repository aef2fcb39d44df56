-- dodgeball.lua: keeps away from the ball, steps aside when it comes flying, kicks one that lies in its own court.
local LOG = "../../scenes/dodgeball.input" -- drives red from the start to 13 s, and stops it at 16 s
local LINE = "../data/player-line.input" -- drives red to the right, with the button held, for 5 s

local halves = require "parts/court"
local function court(ball, own)
  local function player(x, team, side)
    local set = { court = side }
    for name, value in pairs(own or {}) do set[name] = value end
    return { behaviour = "dodgeball.lua", at = { { x, 0 } }, team = team, set = set }
  end
  -- Groups come by name, and logs of input drive agent 0.
  local game = halves(ball, { a_red = player(-4, "red", "red_court"), blue = player(4, "blue", "blue_court") })
  game.walls = { { line = { { -8, -4 }, { 8, -4 }, { 8, 4 }, { -8, 4 } }, closed = true, height = 6 } }
  return game
end
local LIES = { 3, 0, 0.11 }

-- A court whose ball is lobbed from the end of the red court and comes down on blue after 2 s.
local function thrown(own)
  local game = court({ -7, 0.1, 1 }, own)
  game.bodies[1].velocity = { 5.7, 0, 9.5 }
  return scene(game)
end

test("a ball that lies in one's court is attacked at once, by its owner alone", function()
  local s = scene(court(LIES))
  s:reaches("Attack", { agents = "blue", within = 0.2 })
  s:never("Attack", { agents = "a_red", during = 0.8 })
end)

test("the attacker runs to the ball, kicks it high into the other court and turns to defence", function()
  local s = scene(court(LIES))
  local least, fastest, top = 0, 0, 0
  while s:body("ball").x > -0.5 and s:time() < 5 do
    s:step()
    fastest = math.max(fastest, s:agents("blue")[1].now)
    least = math.min(least, s:body("ball").vx)
    top = math.max(top, s:body("ball").z)
  end
  truthy(s:time() < 3, "it takes a moment, not a game")
  near(fastest, 3.5, 0.15)
  truthy(least < -8, "more than 5 m/s, as it runs")
  truthy(top > 0.5, "it flies")
  equal(s:agents("blue")[1].state, "Defense")
end)

test("a ball that comes rolling is kicked straight at the opponent, at its chest", function()
  for _, velocity in ipairs { { 0, 0, 0 }, { -2, 2, 0 }, { 3, -3, 0 } } do
    local game = court(LIES, { attention = 0 })
    game.bodies[1].velocity = velocity
    game.groups.a_red.set.speed = 0
    local s = scene(game)
    s:reaches("Hit", { agents = "a_red", within = 5 })
    local ball, red = s:body("ball"), s:agents("a_red")[1]
    near(ball.y, red.y, 0.35)
    truthy(ball.z > 0.3 and ball.z < 1.3, "it hits at " .. ball.z .. " m")
  end
end)

test("a ball is kicked also where a pillar hides the opponent", function()
  local game = court({ 3, 2, 0.11 })
  game.bodies[2] = { name = "pillar", shape = { box = { size = { 1, 1, 2 } } }, mass = 0, at = { 1.5, 1.5, 1 } }
  local s = scene(game)
  s:run(2)
  local ball = s:body "ball"
  truthy(math.abs(ball.x - 3) + math.abs(ball.y - 2) > 1, "the ball has left its place")
end)

test("a ball in the air is not attacked until it has come down", function()
  local s = scene(court { 5, 0, 3 })
  while s:body("ball").z > 0.5 do
    equal(s:agents("blue")[1].state, "Defense")
    s:step()
  end
  near(s:time(), 0.7, 0.15)
  s:reaches("Attack", { agents = "blue", within = 1 })
end)

test("the defender keeps away from the ball, and not far from its post", function()
  local s = scene(court(LIES))
  s:run(0.7)
  local red = s:agents("a_red")[1]
  equal(red.state, "Defense")
  truthy(red.x < -4.2 and red.x > -5.5, "red is at " .. red.x)
end)

test("a flying ball that is noticed is dodged after the reaction time", function()
  local s = thrown { attention = 1 }
  s:reaches("Notice", { agents = "blue", within = 1.5 })
  local noticed = s:time()
  s:reaches("Dodge", { agents = "blue", within = 0.4 })
  near(s:time() - noticed, 0.3, 0.1)
  s:never("Hit", { agents = "blue", during = 1.5 })
  equal(s:agents("blue")[1].dodges, 1)
  truthy(math.abs(s:agents("blue")[1].y - 0.1) > 0.5, "it stepped aside")
end)

test("of many balls the one that flies at a player is dodged, also by one that runs to another", function()
  local game = court({ -7, 0.1, 1 }, { attention = 1 })
  game.bodies[1].velocity = { 5.7, 0, 9.5 }
  for k, at in ipairs { { 4.5, 1, 0.11 }, { 4, -1.5, 0.11 }, { 5.5, 0, 0.11 } } do
    local ball = {}
    for name, value in pairs(game.bodies[1]) do ball[name] = value end
    ball.name, ball.at, ball.velocity = "lies" .. k, at, nil
    game.bodies[1 + k] = ball
  end
  game.groups.blue.set.speed = 0 -- it attacks, and does not get there
  local s = scene(game)
  s:reaches("Attack", { agents = "blue", within = 0.3 })
  s:reaches("Notice", { agents = "blue", within = 1.5 })
  s:reaches("Dodge", { agents = "blue", within = 0.4 })
end)

test("a flying ball that is not noticed, or too late, hits: a point, and a second of rest", function()
  for _, own in ipairs { { attention = 0 }, { attention = 1, reaction = 2 } } do
    local s = thrown(own)
    s:reaches("Hit", { agents = "blue", within = 2.5 })
    equal(s:agents("blue")[1].hits, 1)
    for _ = 1, 9 do
      s:run(0.1)
      equal(s:agents("blue")[1].state, "Hit")
    end
    s:run(0.15)
    truthy(s:agents("blue")[1].state ~= "Hit", "the game goes on")
    equal(s:agents("blue")[1].hits, 1)
    equal(s:agents("a_red")[1].hits, 0)
  end
end)

test("a ball that touches slowly is no hit", function()
  local rolled = court { 3, 0.3, 0.11 }
  rolled.bodies[1].velocity = { 0.9, 0, 0 }
  rolled.groups.blue.set.speed = 0
  scene(rolled):never("Hit", { agents = "blue", during = 3 })
end)

test("nobody is faster than max_speed, and nobody leaves the court", function()
  local s = scene(court { -3, 1, 0.11 })
  for _ = 1, 20 do
    s:slower_than(4.4, { during = 0.5 }) -- a ball that hits may add to max_speed
    for _, a in ipairs(s:agents()) do
      truthy(math.abs(a.x) < 8 and math.abs(a.y) < 4, "the walls hold")
    end
  end
end)

test("a game goes on by itself: the ball changes sides, is dodged and hits, and stays in the court", function()
  local s = scene(court(LIES))
  local changes, side, top = 0, 1, 0
  while s:time() < 300 do
    s:step()
    local ball = s:body("ball")
    top = math.max(top, ball.z)
    truthy(math.abs(ball.x) < 8 and math.abs(ball.y) < 4, "the ball is in the court")
    if ball.x * side < -0.2 then
      changes, side = changes + 1, -side
    end
  end
  local red, blue = s:agents("a_red")[1], s:agents("blue")[1]
  truthy(changes >= 40, changes .. " changes")
  truthy(red.dodges + blue.dodges >= 5, red.dodges + blue.dodges .. " dodges")
  truthy(red.hits + blue.hits >= 2, red.hits + blue.hits .. " points")
  truthy(top < 5, "the walls are higher than the ball flies")
end)

test("a game is played the same again, on two threads too", function()
  local a, b = scene(court(LIES)), scene(court(LIES), { threads = 2 })
  a:run(8)
  b:run(8)
  equal(a:hash(), b:hash())
end)

test("while it is driven a player does what it is told, and kicks what it touches", function()
  local game = court { -3.1, 0, 0.11 }
  game.player, game.input = "a_red", LOG
  local s = scene(game)
  s:run(0.1)
  local top = 0
  while s:time() < 11 do
    local state = s:agents("a_red")[1].state
    truthy(string.find(state, "Play") == 1 or state == "Strike" or state == "Hit", "a person plays, not " .. state)
    s:step()
    top = math.max(top, s:body("ball").z)
  end
  truthy(top > 0.3, "the ball is kicked")
end)

test("a player runs while the button is held, stops before the line, and is left to the person", function()
  local game = court { 20, 20, 0.11 }
  game.player, game.input = "a_red", LINE
  local s = scene(game)
  s:reaches("Play.Run", { agents = "a_red", within = 0.2 })
  s:reaches("Play.Rest", { agents = "a_red", within = 1.4 })
  local farthest, fastest = -8, 0
  while s:time() < 30 do
    s:step()
    farthest = math.max(farthest, s:agents("a_red")[1].x)
    fastest = math.max(fastest, s:agents("a_red")[1].now)
  end
  truthy(farthest > -0.6 and farthest < -0.15, "the line holds at " .. farthest)
  truthy(string.find(s:agents("a_red")[1].state, "Play") == 1, "the machine does not play for somebody who stands")
end)

test("a ball in the air hits a player who stands in its way", function()
  local game = court({ 2, 0.1, 1 })
  game.bodies[1].velocity = { -9, 0, 3 }
  game.player, game.input = "a_red", "../data/player-stands.input"
  local s = scene(game)
  s:reaches("Hit", { agents = "a_red", within = 2 })
  equal(s:agents("a_red")[1].hits, 1)
  s:reaches("Play", { agents = "a_red", within = 1.2 })
end)

test("a court that is no place is refused", function()
  local bad = court(LIES)
  bad.groups.a_red.set.court = "red_cuort"
  refused(bad, "red_cuort")
end)
