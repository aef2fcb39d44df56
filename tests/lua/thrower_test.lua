-- thrower.lua: fetches a ball in its own court, carries it, throws it at an opponent.
local function court()
  return scene {
    places = {
      red_court = { polygon = { { -8, -4 }, { 0, -4 }, { 0, 4 }, { -8, 4 } } },
      blue_court = { polygon = { { 0, -4 }, { 8, -4 }, { 8, 4 }, { 0, 4 } } },
    },
    walls = { { line = { { -8, -4 }, { 8, -4 }, { 8, 4 }, { -8, 4 } }, closed = true, height = 3 } },
    bodies = {
      { name = "ball", shape = { sphere = { radius = 0.11 } }, mass = 0.4, at = { -3, 2, 0.11 },
        restitution = 0.6, tags = { "ball" } },
    },
    groups = {
      red = { behaviour = "thrower.lua", at = { { -5, 0 } }, team = "red", set = { court = "red_court" } },
      blue = { behaviour = "thrower.lua", at = { { 5, 0 } }, team = "blue", set = { court = "blue_court" } },
    },
  }
end

test("the ball is fetched, carried in the hand, and thrown over the line", function()
  local s = court()
  s:reaches("Aim", { agents = "red", within = 6 })
  local me, ball = s:agents("red")[1], s:body("ball")
  near(ball.z, 1.2, 0.3)
  near(ball.x, me.x, 0.6)
  s:reaches("Throw", { agents = "red", within = 3 })
  s:run(0.7)
  truthy(s:body("ball").x > -1, "it flies")
  equal(s:agents("red")[1].throws, 1)
end)

test("only the side that has the ball attacks at first", function()
  court():never("Fetch", { during = 3, agents = "blue" })
end)

test("a game of a minute has throws and hits, and is the same again", function()
  local a, b = court(), court()
  a:run(60)
  b:run(60)
  local throws, hits = 0, 0
  for _, agent in ipairs(a:agents()) do
    throws = throws + agent.throws
    hits = hits + agent.hits
  end
  truthy(throws >= 4 and hits >= 1, throws .. " throws, " .. hits .. " hits")
  equal(a:hash(), b:hash())
end)
