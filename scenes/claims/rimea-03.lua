local measure = require "measure"

local function descend(speed, more)
  local run = { scene = "../rimea-03.yaml", seeds = 1, set = { ["groups.person.set.stair_down"] = speed } }
  for key, value in pairs(more or {}) do run[key] = value end
  return run
end

return claim {
  id = "R3", also = "I3", title = "RiMEA 3: keeping a speed down a stair",
  source = "RiMEA guideline, test 3; IMO MSC.1/Circ.1533, test 3 (by notes of it)",
  text = "One person walks down a stair 2 m wide, for 10 m along its slope. At a speed of 1 m/s on stairs that takes 10 s, and at "
    .. "0.5 m/s 20 s. The speed is a parameter of the person, `stair_down`. Bands of 5 % are those of JuPedSim's tests.",
  level = "normal", held_out = measure.walking_law,
  runs = { fast = descend(1), slow = descend(0.5, { duration = 60 }), coarse = descend(1, { dt = 0.2 }) },
  null = { text = "a person who is a tenth slower on stairs", runs = {
    fast = { set = { ["groups.person.set.stair_down"] = 0.9 } }, slow = { set = { ["groups.person.set.stair_down"] = 0.45 } },
    coarse = { set = { ["groups.person.set.stair_down"] = 0.9 } } } },
  measure = function(run)
    local function time(name) return run[name].summary.probes.timed.mean end
    return { fast = time("fast"), slow = time("slow"), coarse = time("coarse") }
  end,
  expect = {
    { "fast", unit = "s", what = "time for 10 m down, at 1 m/s", source = "10, within 5 %", band = { 9.5, 10.5 } },
    { "slow", unit = "s", what = "time for 10 m down, at 0.5 m/s", source = "20, within 5 %", band = { 19, 21 } },
    { "coarse", unit = "s", what = "at 1 m/s, dt 0.2 s", source = "10, within 5 %; other dt ours", band = { 9.5, 10.5 } },
  },
}
