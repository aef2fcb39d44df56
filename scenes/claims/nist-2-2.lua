local measure = require "measure"

local down = { -- the same stair, from its head
  ["groups.person.at.0.0"] = 89.3, ["groups.person.storey"] = "upper", ["groups.person.set.stair_down"] = 1,
  ["groups.person.set.goal"] = "ground_end",
  ["probes.timed.transit.0.0.0"] = 87.469, ["probes.timed.transit.0.1.0"] = 87.469,
  ["probes.timed.transit.1.0.0"] = 0.866, ["probes.timed.transit.1.1.0"] = 0.866,
}

return claim {
  id = "N2.2", title = "NIST 2.2: keeping a speed over a long stair",
  source = "NIST TN 1822, test 2.2, as implemented by the verification notebooks of JuPedSim",
  text = "One person walks 100 m along the slope of a stair, up and down, at 1 m/s. That takes 100 s, within 5 %.",
  level = "calm", held_out = measure.walking_law,
  runs = measure.calm({
    up = { scene = "../nist-2-2.yaml", seeds = 1 }, down = { scene = "../nist-2-2.yaml", seeds = 1, set = down },
  }, "person"),
  null = { text = "a person who is a tenth slower on stairs, at 0.9 m/s",
    set = { ["groups.person.set.stair_up"] = 0.9, ["groups.person.set.stair_down"] = 0.9 } },
  measure = function(run)
    return { up = run.up.summary.probes.timed.mean, down = run.down.summary.probes.timed.mean }
  end,
  expect = {
    { "up", unit = "s", what = "time for 100 m up", source = "100, within 5 %", band = { 95, 105 } },
    { "down", unit = "s", what = "time for 100 m down", source = "100, within 5 %", band = { 95, 105 } },
  },
}
