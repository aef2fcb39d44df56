-- rescuer.lua and casualty.lua: two take hold of who lies, and carry them to a refuge.
local function hall(rescuers)
  return scene {
    forces = { enabled = true },
    places = {
      refuge = { polygon = { { 10, -3 }, { 20, -3 }, { 20, 3 }, { 10, 3 } } },
      beds   = { polygon = { { 13, -3 }, { 20, -3 }, { 20, 3 }, { 13, 3 } } },
    },
    groups = {
      rescuers   = { behaviour = "rescuer.lua", at = rescuers, set = { refuge = "beds" } },
      casualties = {
        behaviour = "casualty.lua", at = { { 0, 0 } }, tags = { "casualties" }, set = { refuge = "refuge" },
      },
    },
  }
end

test("whom two hold on to is carried, and is safe where they go", function()
  local s = hall { { -1.2, 0.6 }, { -1.2, -0.6 } }
  s:reaches("Carried", { agents = "casualties", within = 5 })
  s:run(3)
  local before = s:agents("casualties")[1].x
  s:run(4)
  truthy(s:agents("casualties")[1].x - before > 0.6 * 0.9 * 4, "carried at three fifths of 0.9 m/s at least")
  s:reaches("Safe", { agents = "casualties", within = 15 })
  s:reaches("Fetch", { agents = "rescuers", within = 3 })
end)

test("one alone waits for a second", function()
  local s = hall { { -1.2, 0 } }
  s:reaches("Lift", { agents = "rescuers", within = 5 })
  s:never("Carry", { agents = "rescuers", during = 5 })
  near(s:agents("casualties")[1].x, 0, 0.6)
end)
