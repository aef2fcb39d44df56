-- sprinter.lua and tackler.lua: runs for a zone; runs into who does, and holds on until they are down.
local function pitch(tacklers, mass)
  local groups = {
    runners = {
      behaviour = "sprinter.lua", at = { { 0, 0 } }, tags = { "runners" },
      set = { zone = "zone", speed = 5.5, mass = mass or 85 },
    },
  }
  if tacklers then
    groups.tacklers = {
      behaviour = "tackler.lua", at = tacklers, tags = { "tacklers" }, set = { speed = 5, mass = 95 },
    }
  end
  return scene {
    forces = { enabled = true },
    places = { zone = { polygon = { { 25, -10 }, { 30, -10 }, { 30, 10 }, { 25, 10 } } } },
    groups = groups,
  }
end

test("whom nobody stops gets home", function()
  local s = pitch()
  s:reaches("Home", { agents = "runners", within = 6 })
  equal(s:agents("runners")[1].home, true)
end)

test("whoever is run into is held, dragged about and goes down", function()
  local s = pitch { { 12, 2 } }
  s:reaches("Held", { agents = "runners", within = 4 })
  equal(s:agents("tacklers")[1].state, "Hold")
  s:reaches("Down", { agents = "runners", within = 3 })
  s:never("Home", { agents = "runners", during = 3 })
  local one, other = s:agents("runners")[1], s:agents("tacklers")[1]
  near(one.x, other.x, 1)
  near(one.y, other.y, 1)
end)

test("who weighs too much for one drags them along", function()
  local light, heavy = pitch({ { 12, 2 } }, 85), pitch({ { 12, 2 } }, 400)
  for _, s in ipairs { light, heavy } do
    s:reaches("Held", { agents = "runners", within = 4 })
    s:run(1)
  end
  truthy(heavy:agents("runners")[1].x > light:agents("runners")[1].x + 0.5, "the one who weighs more comes farther")
end)

test("whom nobody comes near, nobody chases", function()
  pitch({ { 12, 9 } }):never("Chase", { during = 4, agents = "tacklers" })
end)
