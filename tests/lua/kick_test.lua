-- The action `kick`: how far and how high a lifted kick sends a ball.
local function kicker(kick)
  return ([[local ball = nearest "ball"
    return machine { name = "kicker", version = 1, start = "Kick", defaults = { perception = 9 }, states = {
      Kick = { steer = hold, kick = { ball, at = "post", %s }, { to = "Done", when = kicked(ball) } },
      Done = { steer = hold } } }]]):format(kick)
end

-- Returns x where a ball of radius 0.11 m that is kicked at x = 0 comes down, and its greatest height, m.
local function flight(kick)
  local s = scene {
    places = { post = { point = { 20, 0 } } },
    bodies = { { name = "ball", shape = { sphere = { radius = 0.11 } }, mass = 0.4, at = { 0, 0, 0.11 },
      restitution = 0, tags = { "ball" } } },
    groups = { one = { behaviour = kicker(kick), at = { { -0.32, 0 } } } },
    step = 0.01,
  }
  local top = 0
  s:run(0.1)
  equal(s:agents("one")[1].state, "Done")
  while s:body("ball").z > 0.115 do
    top = math.max(top, s:body("ball").z)
    s:step()
  end
  return s:body("ball").x, top
end

test("a lifted kick flies the parabola of its speed and angle", function()
  local G, SPEED = 9.81, 8
  for _, degrees in ipairs { 20, 45, 70 } do
    local vx, vz = SPEED * math.cos(math.rad(degrees)), SPEED * math.sin(math.rad(degrees))
    local x, top = flight("impulse = 8, lift = " .. degrees)
    near(x, 2 * vx * vz / G, 0.25)
    near(top, 0.11 + vz * vz / (2 * G), 0.05)
  end
end)

test("a kick without lift stays on the ground", function()
  local _, top = flight "impulse = 8"
  equal(top, 0)
end)

test("lift may be an expression", function()
  local _, expected = flight "impulse = 8, lift = 40"
  local _, top = flight "impulse = 8, lift = min(20 + 5 * count \"post\", 90) + 20"
  equal(top, expected)
end)

-- Returns the ball's velocity after a kick at a post that lies east of it; it came with this velocity.
local function kicked(kick, vx, vy)
  local s = scene {
    places = { post = { point = { 20, 0 } } },
    bodies = { { name = "ball", shape = { sphere = { radius = 0.11 } }, mass = 0.4, at = { 0, 0, 0.11 },
      velocity = { vx, vy, 0 }, tags = { "ball" } } },
    groups = { one = { behaviour = kicker(kick), at = { { -0.32, 0 } } } },
    step = 0.01,
  }
  s:run(0.03)
  return s:body "ball"
end

test("a kick with a speed replaces the ball's velocity, one with an impulse adds to it", function()
  for _, came in ipairs { { 0, 0 }, { -2, 3 }, { 3, -2 } } do
    local given, added = kicked("speed = 8", came[1], came[2]), kicked("impulse = 8", came[1], came[2])
    near(given.vx, 8, 0.3)
    near(given.vy, 0, 0.1)
    near(added.vx, 8 + came[1], 0.3)
    near(added.vy, came[2], 0.3)
  end
end)

test("a kick with a speed of 0 stops the ball", function()
  local ball = kicked("speed = 0", -1, 1)
  near(ball.vx, 0, 0.05)
  near(ball.vy, 0, 0.05)
end)

test("a kicked ball passes the kicker's own body, and goes where it is aimed at", function()
  for _, lift in ipairs { 0, 20 } do
    for _, impulse in ipairs { 1.5, 8 } do -- too slow to be swept, and swept
      local s = scene {
        places = { post = { point = { 20, 0 } } },
        bodies = { { name = "ball", shape = { sphere = { radius = 0.11 } }, mass = 0.4, at = { 0, 0, 0.11 },
          tags = { "ball" } } },
        -- The kicker stands between the ball and the post.
        groups = { one = { behaviour = kicker(("impulse = %g, lift = %g"):format(impulse, lift)),
          at = { { 0.32, 0.02 } } } },
      }
      s:run(0.6)
      truthy(s:body("ball").x > 0.6, "the ball is beyond the kicker, at " .. s:body("ball").x)
      near(s:body("ball").y, 0, 0.02)
      near(s:agents("one")[1].x, 0.32, 0.01)
    end
  end
end)

test("a ball that comes back to the kicker from a wall meets it", function()
  local s = scene {
    places = { post = { point = { 20, 0 } } },
    walls = { { line = { { 1, -2 }, { 1, 2 } }, height = 3 } },
    bodies = { { name = "ball", shape = { sphere = { radius = 0.11 } }, mass = 0.4, at = { 0, 0, 0.11 },
      restitution = 1, tags = { "ball" } } },
    groups = { one = { behaviour = kicker("impulse = 8"), at = { { -0.32, 0 } } } },
  }
  s:run(1)
  truthy(s:agents("one")[1].x < -0.4, "it pushes the kicker back")
end)
