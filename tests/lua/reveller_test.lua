-- reveller.lua: comes to a place, stays there; with a drive it presses, and turns to where it is carried.
local function square(drive, carry, way)
  return {
    places = { left = { point = { 2, 5 } }, right = { point = { 8, 5 } }, spots = { set = { "left", "right" } } },
    groups = {
      people = { behaviour = "reveller.lua", at = { { 1, 5 }, { 9, 5 } }, set = { spots = "spots" },
        memory = { drive = drive, carry = carry, way = way } },
    },
  }
end

test("without a drive people stand at their places", function()
  local s = scene(square(0, 1, 0))
  s:run(15)
  equal(s:count("Stand"), 2)
  for _, a in ipairs(s:agents()) do
    truthy(math.abs(a.x - 5) > 1.4 and math.abs(a.x - 5) < 4.6, "not at a place")
  end
  s:slower_than(0.01, { during = 5 })
end)

test("who presses goes on the way that it has while nobody is in the way", function()
  local s = scene(square(0.3, 1000, 1.5708))
  s:run(20)
  equal(s:count("Press"), 2)
  for _, a in ipairs(s:agents()) do
    near(a.vx, 0, 0.02)
    near(a.vy, 0.3, 0.02)
  end
end)

-- A wall stands across the way of who presses east, a little turned, so that it carries people to the north.
local function turned(carry)
  local def = square(0.3, carry, 0)
  def.groups.people.at = { { 2, 5 } }
  def.places.spots.set = { "left" }
  def.walls = { { line = { { 3, 0 }, { 4, 20 } } } }
  local s = scene(def)
  s:run(40)
  return s:agents()[1]
end

test("the way turns to where one is carried, sooner over a short way", function()
  local short, long = turned(0.5), turned(1e6)
  near(short.vy, 0.3, 0.03) -- along the wall as fast as its feet would go
  truthy(long.vy < 0.1, "it presses on against the wall")
  truthy(short.y > long.y + 2)
end)
