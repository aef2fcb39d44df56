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
