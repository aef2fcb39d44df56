-- dodgeball.lua: runs from a ball that flies or lies in the other court; kicks one that lies in its own.
local halves = require "parts/court"
local function court(ball)
  local game = halves(ball, {
    red = { behaviour = "dodgeball.lua", at = { { -4, 0 } }, team = "red", set = { court = "red_court" } },
    blue = { behaviour = "dodgeball.lua", at = { { 4, 0 } }, team = "blue", set = { court = "blue_court" } },
  })
  game.walls = { { line = { { -8, -4 }, { 8, -4 }, { 8, 4 }, { -8, 4 } }, closed = true, height = 1 } }
  return game
end
local LIES = { 3, 0, 0.11 }

test("a ball that lies in one's court is attacked at once, by its owner alone", function()
  local s = scene(court(LIES))
  s:reaches("Attack", { agents = "blue", within = 0.2 })
  s:never("Attack", { agents = "red", during = 0.8 })
end)

test("the attacker kicks it into the other court and turns to defence", function()
  local s = scene(court(LIES))
  local least, fastest = 0, 0
  while s:body("ball").x > -0.5 and s:time() < 5 do
    s:step()
    fastest = math.max(fastest, s:agents("blue")[1].now)
    least = math.min(least, s:body("ball").vx)
  end
  truthy(s:time() < 3, "it takes a moment, not a game")
  near(fastest, 3, 0.1)
  truthy(least < -3.5, "at least 2 Ns per kg, and more as it runs; it brakes in its last step")
  equal(s:agents("blue")[1].state, "Defense")
  s:reaches("Attack", { agents = "red", within = 1 })
end)

test("a ball in the air is run from, not attacked, until it has come down", function()
  local s = scene(court({ 5, 0, 3 }))
  local ball = s:body("ball")
  while ball.z > 0.5 do
    equal(s:agents("blue")[1].state, "Defense")
    s:step()
    ball = s:body("ball")
  end
  near(s:time(), 0.7, 0.15)
  truthy(s:agents("blue")[1].x < 3, "away from the ball")
  s:reaches("Attack", { agents = "blue", within = 1 })
end)

test("who defends keeps away from the ball", function()
  local s = scene(court(LIES))
  s:run(0.7)
  local red = s:agents("red")[1]
  equal(red.state, "Defense")
  near(red.now, 2.5, 0.1)
  truthy(red.x < -5.5, "red runs from the ball on the other side")
end)

test("who defends and is hit by a ball that flies has a point against it, and stands for a second", function()
  local thrown = court({ 1, 0, 1.2 })
  thrown.bodies[1].velocity = { 9, 0, 0 }
  local s = scene(thrown)
  s:reaches("Hit", { agents = "blue", within = 0.8 })
  equal(s:agents("blue")[1].hits, 1)
  for _ = 1, 9 do
    s:run(0.1)
    equal(s:agents("blue")[1].state, "Hit")
  end
  s:run(0.15)
  truthy(s:agents("blue")[1].state ~= "Hit", "the game goes on")
  equal(s:agents("blue")[1].hits, 1)
  equal(s:agents("red")[1].hits, 0)
end)

test("a ball that touches slowly is no hit", function()
  local rolled = court({ 3, 0.3, 0.11 })
  rolled.bodies[1].velocity = { 0.9, 0, 0 }
  rolled.groups.blue.set.speed = 0
  scene(rolled):never("Hit", { agents = "blue", during = 3 })
end)

test("nobody is faster than max_speed, and nobody leaves the court", function()
  local s = scene(court({ -3, 1, 0.11 }))
  for _ = 1, 20 do
    s:slower_than(4.4, { during = 0.5 }) -- a ball that hits may add to max_speed
    for _, a in ipairs(s:agents()) do
      truthy(math.abs(a.x) < 8 and math.abs(a.y) < 4, "the walls hold")
    end
  end
end)

test("both come to attack in a game, and the ball changes sides", function()
  local s = scene(court(LIES))
  local changes, side = 0, 1
  for _ = 1, 400 do
    s:step()
    local x = s:body("ball").x
    if x * side < -0.2 then
      changes, side = changes + 1, -side
    end
  end
  equal(s:entered("Attack"), 2)
  truthy(changes >= 2, "there and back at least")
end)

test("a game is played the same again, on two threads too", function()
  local a, b = scene(court(LIES)), scene(court(LIES), { threads = 2 })
  a:run(8)
  b:run(8)
  equal(a:hash(), b:hash())
end)

test("a court that is no place is refused", function()
  local bad = court(LIES)
  bad.groups.red.set.court = "red_cuort"
  refused(bad, "red_cuort")
end)
