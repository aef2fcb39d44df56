-- Functions of behaviours see whom the words see: the same agents, nearest first, to the same distance.
local QUIET = [[return machine { name = "quiet", start = "Quiet", states = { Quiet = { steer = hold } } }]]
local ZOMBIE = [[return machine { name = "zombie", start = "Zombie", states = { Zombie = { steer = hold } } }]]
local GUN = [[
  local zombie = nearest("anyone"):of_machine("zombie")
  memory { seen = 0, found = false, sorted = true, counted = 0 }
  return machine { name = "gun", start = "Watch", defaults = { perception = 20, neighbours = 16 }, states = {
    Watch = { steer = hold, { to = "Shoot", when = sees(zombie) }, { to = "Idle", when = after(0.5) } },
    Idle = { steer = hold, on_enter = function(me)
      for _, other in ipairs(me.neighbours) do me.found = me.found or other.machine == "zombie" end end },
    Shoot = { steer = hold, set = { counted = neighbours "anyone" }, on_enter = function(me)
      local last = 0
      for _, other in ipairs(me.neighbours) do
        local away = math.sqrt((other.x - me.x) ^ 2 + (other.y - me.y) ^ 2)
        me.sorted = me.sorted and away >= last
        last, me.seen = away, me.seen + 1
        me.found = me.found or other.machine == "zombie"
      end
    end } } }]]

-- One with a gun, a zombie 8 m away, and so many about the gun.
local function yard(quiet, walls)
  local at = {}
  for i = 1, quiet do at[i] = { math.cos(i * 0.8) * (1 + i / 9), math.sin(i * 0.8) * (1 + i / 9) } end
  return scene { walls = walls, groups = {
    gun = { behaviour = GUN, at = { { 0, 0 } } },
    quiet = { behaviour = QUIET, at = at },
    zombies = { behaviour = ZOMBIE, at = { { 0, 8.5 } } } } }
end

for _, quiet in ipairs { 3, 20, 62 } do
  test("whom sees() sees, me.neighbours has, among " .. quiet, function()
    local s = yard(quiet)
    s:run(0.2)
    local gun = s:agents("gun")[1]
    equal(gun.state, "Shoot")
    truthy(gun.found and gun.sorted)
    equal(gun.seen, quiet + 1)
    equal(gun.counted, quiet + 1)
  end)
end

test("in a larger crowd both have the nearest alone", function()
  local s = yard(70)
  s:run(1)
  local gun = s:agents("gun")[1]
  equal(gun.state, "Idle")
  equal(gun.found, false)
end)

test("neither sees through a wall", function()
  local s = yard(2, { { line = { { -3, 7 }, { 3, 7 } } } })
  s:run(1)
  local gun = s:agents("gun")[1]
  equal(gun.state, "Idle")
  equal(gun.found, false)
end)

-- Reaches the state Seen once the target exists.
local function looks_for(target)
  return ([[return machine { name = "looks", version = 1, start = "Look", defaults = { perception = 20 }, states = {
    Look = { steer = hold, { to = "Seen", when = sees(%s) } },
    Seen = { steer = hold, { to = "Look", when = ~sees(%s) } } } }]]):format(target, target)
end

-- A person at (0, 0) among balls that lie near by, and one that is thrown from (-6, y) along x.
local function among_balls(target, y)
  local ball = function(name, at, velocity)
    return { name = name, at = at, velocity = velocity, tags = { "ball" },
      shape = { sphere = { radius = 0.11 } }, mass = 0.4 }
  end
  return scene {
    bodies = { ball("lies", { 1, 0, 0.11 }), ball("thrown", { -6, y, 1 }, { 6, 0, 4 }) },
    groups = { one = { behaviour = looks_for(target), at = { { 0, 0 } } } },
  }
end

local function run_while_seen(s)
  s:reaches("Seen", { within = 0.1 })
  while s:agents("one")[1].state == "Seen" and s:time() < 3 do s:step() end
end

test("nearest flying body: not one that lies, though that is nearer", function()
  local s = among_balls('nearest("ball"):flying()', 3)
  run_while_seen(s)
  truthy(s:body("thrown").z < 0.3, "it has come down")
end)

test("nearest incoming body: one that passes within the distance, until it has passed", function()
  local s = among_balls('nearest("ball"):flying():incoming(0.6)', 0.5)
  run_while_seen(s)
  truthy(s:body("thrown").x > -0.2, "it has passed")
  among_balls('nearest("ball"):flying():incoming(0.6)', 0.7):never("Seen", { during = 1.2 })
end)

test("nearest incoming agent: one that walks by, not one that stands", function()
  local walks = [[return machine { name = "walks", version = 1, start = "Walk", states = {
    Walk = { steer = drift(1, 0) } } }]]
  local function passed_by(y)
    return scene {
      groups = {
        one = { behaviour = looks_for('nearest("others"):incoming(1)'), at = { { 0, 0 } } },
        stands = { behaviour = "stander.lua", at = { { 0.6, 0 } }, tags = { "others" } },
        walks = { behaviour = walks, at = { { -3, y } }, tags = { "others" } },
      },
    }
  end
  passed_by(-0.9):reaches("Seen", { agents = "one", within = 2 })
  passed_by(-1.6):never("Seen", { agents = "one", during = 3 })
end)
