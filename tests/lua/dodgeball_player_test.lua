-- dodgeball_player.lua: as player.lua, of which player_test.lua holds too; left alone it plays by itself.
local LOG = "../../scenes/dodgeball.input" -- 2 s at 1.5 m/s to the right, 2 s of rest, then up and down

local halves = require "parts/court"
local function court(ball, input)
  local game = halves(ball, {
    a_red = { behaviour = "dodgeball_player.lua", at = { { -4, 0 } }, team = "red", set = { court = "red_court" } },
    blue = { behaviour = "dodgeball.lua", at = { { 5, 0 } }, team = "blue", set = { court = "blue_court" } },
  })
  game.player, game.input = "a_red", input
  return game
end
local AWAY = { -20, 20, 0.11 }

test("as long as it is driven it knows one state alone", function()
  local s = scene(court(AWAY, LOG))
  s:run(5)
  equal(s:agents("a_red")[1].state, "Play")
  equal(s:entered("Play"), 1)
end)

test("left alone for 8 s it kicks a ball that lies in its court, until it is driven again", function()
  local s = scene(court({ -2, 1, 0.11 }, "../data/player-returns.input"))
  s:never("Defend", { agents = "a_red", during = 7.8 })
  s:reaches("Attack", { agents = "a_red", within = 1.5 })
  while s:body("ball").x < 0.5 and s:time() < 14 do
    s:step()
  end
  truthy(s:time() < 14, "the ball is in the other court")
  s:run(15.05 - s:time())
  equal(s:agents("a_red")[1].state, "Play")
  s:run(1) -- nobody turns round on the spot
  local x = s:agents("a_red")[1].x
  s:run(0.9)
  near(s:agents("a_red")[1].x, x + 0.9, 0.15)
end)
