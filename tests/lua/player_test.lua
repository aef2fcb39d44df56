-- player.lua: a person drives this agent; touching the ball kicks it at an opponent.
local LOG = "../../scenes/dodgeball.input" -- 2 s at 1.5 m/s to the right, 2 s of rest, then up and down

local halves = require "parts/court"
local function court(ball, input)
  local game = halves(ball, {
    a_red = { behaviour = "player.lua", at = { { -4, 0 } }, team = "red" },
    blue = { behaviour = "dodgeball.lua", at = { { 5, 0 } }, team = "blue", set = { court = "blue_court" } },
  })
  game.player, game.input = "a_red", input
  return game
end
local AWAY = { -20, 20, 0.11 }

test("it goes where the log says, and stands when the log says so", function()
  local s = scene(court(AWAY, LOG))
  s:run(2)
  local me = s:agents("a_red")[1]
  near(me.x, -1, 0.1)
  near(me.y, 0, 0.05)
  s:run(1.4) -- nobody stops on the spot
  s:slower_than(0.25, { agents = "a_red", during = 0.5 })
  s:run(2.1)
  truthy(s:agents("a_red")[1].y > 1.5, "from 4 s on it walks up")
  s:run(4)
  truthy(s:agents("a_red")[1].y < -1, "and from 6 s on down")
end)

test("without a log nobody drives it, and it stays", function()
  local s = scene(court(AWAY))
  s:slower_than(0.01, { agents = "a_red", during = 5 })
  near(s:agents("a_red")[1].x, -4, 0.01)
end)

test("it knows one state alone", function()
  local s = scene(court(AWAY, LOG))
  s:run(5)
  equal(s:agents("a_red")[1].state, "Play")
  equal(s:entered("Play"), 1)
end)

test("the ball that it touches flies at the opponent, not before and not aside", function()
  local s = scene(court({ -2.5, 0, 0.11 }, LOG))
  s:run(0.4)
  near(s:body("ball").vx, 0, 0.01)
  near(s:body("ball").x, -2.5, 0.01)
  while s:body("ball").vx < 1 and s:time() < 2 do
    s:step()
  end
  local ball, me = s:body("ball"), s:agents("a_red")[1]
  truthy(ball.vx > 4, "kicked with 2 Ns and more: over 4 m/s")
  truthy(math.abs(ball.vy) < 0.25 * ball.vx, "towards the opponent")
  truthy(ball.x - me.x < 1.2, "only a ball that is touched is kicked")
  local x = ball.x
  s:run(0.2)
  truthy(s:body("ball").x > x + 0.5)
end)

test("the same log is the same run", function()
  local ball = { -2.5, 0, 0.11 }
  local a, b, c = scene(court(ball, LOG)), scene(court(ball, LOG)), scene(court(ball))
  a:run(6)
  b:run(6)
  c:run(6)
  equal(a:hash(), b:hash())
  truthy(a:hash() ~= c:hash(), "input changes the run")
end)
