-- `field` leads round walls to what is no place: where somebody was last seen, the own post, a person behind a counter;
-- and `spread_over` puts people evenly over a place.
local WALLS = { { line = { { 0, -6 }, { 0, 6 } } }, { line = { { -6, 6 }, { 0, 6 } } } }
local PREY = [[
  return machine { name = "prey", start = "Go", defaults = { speed = 1, radius = 0.2 }, states = {
    Go = { steer = drift(1, 0), { to = "Up", when = after(3) } },
    Up = { steer = drift(0, 1), { to = "Stop", when = after(7) } },
    Stop = {} } }]]

local function hunt(word)
  return scene { walls = WALLS, groups = {
    prey = { behaviour = PREY, at = { { -1, -7 } }, tags = { "prey" } },
    hunter = { at = { { -3, 0 } }, behaviour = [[
      local mine = memory { prey = nobody }
      return machine { name = "hunter", start = "Look", defaults = { speed = 1.5, perception = 12, radius = 0.2 },
        states = {
          Look = { { to = "Chase", when = sees(nearest "prey"), set = { prey = nearest "prey" } } },
          Chase = { steer = ]] .. word .. [[(last_seen(mine.prey)), { to = "Back", when = near(mine.prey, 0.8) } },
          Back = { steer = ]] .. word .. [[(home), { to = "There", when = near(home, 0.4) } },
          There = {} } }]] } } }
end

test("people go round a wall to where they saw somebody, and home", function()
  hunt("field"):reaches("There", { within = 40, agents = "hunter" })
end)

test("straight ahead they stay at the wall", function()
  hunt("seek"):never("There", { during = 40, agents = "hunter" })
end)

-- A guest behind a counter that hides nobody, and a waiter before it.
local function serve(word, walls)
  return scene { walls = walls, groups = {
    guest = { at = { { 0, 3 } }, tags = { "guest" },
      behaviour = [[return machine { name = "guest", start = "Sit", states = { Sit = {} } }]] },
    waiter = { at = { { 0, 0 } }, behaviour = [[
      return machine { name = "waiter", start = "Go", defaults = { perception = 20 }, states = {
        Go = { steer = ]] .. word .. [[(nearest "guest"), { to = "Served", when = near(nearest "guest", 1) } },
        Served = { steer = hold } } }]] } } }
end
local COUNTER = { { line = { { -4, 1.5 }, { 4, 1.5 } }, height = 1 } }
local COUNTERS = { { line = { { -4, 1.5 }, { 4, 1.5 }, { 4, 5 }, { -4, 5 }, { -4, 1.5 } }, height = 1 } }

test("people go round a low wall to whom they see over it", function()
  serve("field", COUNTER):reaches("Served", { within = 20, agents = "waiter" })
end)

test("straight ahead they stay at the low wall", function()
  serve("seek", COUNTER):never("Served", { during = 20, agents = "waiter" })
end)

test("where no way leads to them, people go as near as they get", function()
  local s = serve("field", COUNTERS)
  s:never("Served", { during = 20, agents = "waiter" })
  truthy(s:agents("waiter")[1].y > 0.9)
end)

-- The distance of each of the people to the nearest other one: the least, and the mean.
local function gaps(s)
  local all, least, sum = s:agents("people"), math.huge, 0
  for _, a in ipairs(all) do
    local nearest = math.huge
    for _, b in ipairs(all) do
      if a ~= b then nearest = math.min(nearest, math.sqrt((a.x - b.x) ^ 2 + (a.y - b.y) ^ 2)) end
    end
    least, sum = math.min(least, nearest), sum + nearest
  end
  return least, sum / #all
end

local function crowd(word, count)
  return scene { seed = 3, places = {
      yard = { polygon = { { 0, 0 }, { 20, 0 }, { 20, 12 }, { 0, 12 } } },
      corner = { polygon = { { 1, 1 }, { 6, 1 }, { 6, 6 }, { 1, 6 } } } },
    walls = { { line = { { 10, 0 }, { 10, 8 } } } },
    groups = { people = { count = count, ["in"] = "corner", behaviour = [[
      return machine { name = "crowd", start = "Go", defaults = { perception = 6 }, states = {
        Go = { steer = ]] .. word .. [[ } } }]] } } }
end

test("people spread evenly over a place, each as far from others as there is room", function()
  local s = crowd('spread_over "yard"', 40)
  s:run(60)
  local least, mean = gaps(s)
  local ideal = math.sqrt(2 / math.sqrt(3) * 20 * 12 / 40) -- of a staggered lattice without a border
  truthy(least > 0.6 * ideal)
  truthy(mean > 0.75 * ideal)
end)

test("people who gather in it stand together", function()
  local s = crowd('gather "yard"', 40)
  s:run(60)
  local _, mean = gaps(s)
  truthy(mean < 1.2)
end)
