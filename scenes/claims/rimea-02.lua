local measure = require "measure"

local function climb(speed, more)
  local run = { scene = "../rimea-02.yaml", seeds = 1, set = { ["groups.person.set.stair_up"] = speed } }
  for key, value in pairs(more or {}) do run[key] = value end
  return run
end

return claim {
  id = "R2", also = "I2", title = "RiMEA 2: keeping a speed up a stair",
  source = "RiMEA guideline, test 2; IMO MSC.1/Circ.1533, test 2 (by notes of it)",
  text = "One person walks up a stair 2 m wide, for 10 m along its slope. At a speed of 1 m/s on stairs that takes 10 s, and at "
    .. "0.5 m/s 20 s. The speed is a parameter of the person, `stair_up`. Bands of 5 % are those of JuPedSim's tests.",
  level = "normal", held_out = measure.walking_law,
  runs = { fast = climb(1), slow = climb(0.5, { duration = 60 }), coarse = climb(1, { dt = 0.2 }) },
  null = { text = "a person who is a tenth slower on stairs", runs = {
    fast = { set = { ["groups.person.set.stair_up"] = 0.9 } }, slow = { set = { ["groups.person.set.stair_up"] = 0.45 } },
    coarse = { set = { ["groups.person.set.stair_up"] = 0.9 } } } },
  measure = function(run)
    local function time(name) return run[name].summary.probes.timed.mean end
    return { fast = time("fast"), slow = time("slow"), coarse = time("coarse") }
  end,
  expect = {
    { "fast", unit = "s", what = "time for 10 m up, at 1 m/s", source = "10, within 5 %", band = { 9.5, 10.5 } },
    { "slow", unit = "s", what = "time for 10 m up, at 0.5 m/s", source = "20, within 5 %", band = { 19, 21 } },
    { "coarse", unit = "s", what = "at 1 m/s, dt 0.2 s", source = "10, within 5 %; other dt ours", band = { 9.5, 10.5 } },
  },
}
