local measure = require "measure"

-- The more people come the other way, the longer it takes; at most a hundred, as in the scene.
local function against(count)
  return { scene = "../counter-rooms.yaml", seeds = "101-103", set = { ["groups.westward.count"] = count } }
end
-- Nobody comes: one begins at the goal, and leaves at once.
local nobody = { ["groups.westward.count"] = 1, ["groups.westward.set.goal"] = "east" }

return claim {
  id = "I8", also = "N2.8", title = "IMO 8 and NIST 2.8: two rooms and a corridor, both ways",
  source = "IMO MSC.1/Circ.1533, test 8, and NIST TN 1822, test 2.8, as implemented by the verification notebooks of JuPedSim",
  text = "A hundred people go from one room to another by a corridor of 10 x 2 m, against none, 10, 50 and 100. The time "
    .. "until the last has arrived rises with the number of those who come, and nobody is stuck.",
  level = "calm", held_out = measure.walking_law,
  runs = measure.calm({
    r0 = { scene = "../counter-rooms.yaml", seeds = "101-103", set = nobody }, r10 = against(10), r50 = against(50),
    r100 = against(100),
  }, "eastward", "westward"),
  quick = { r0 = { seeds = 1 }, r10 = { seeds = 1 }, r50 = { seeds = 1 }, r100 = { seeds = 1 } },
  null = { text = "nobody comes the other way in all runs", set = nobody },
  measure = function(run)
    local times, arrived = {}, {}
    for _, n in ipairs { 0, 10, 50, 100 } do
      local probe = run["r" .. n].summary.probes.eastward
      times[n] = probe.last
      arrived[#arrived + 1] = probe.forward - probe.back
    end
    return { t0 = times[0], t10 = times[10] - times[0], t50 = times[50] - times[10], t100 = times[100] - times[50],
      arrived = measure.least(arrived) }
  end,
  expect = {
    { "t0", unit = "s", what = "until the hundredth has passed, nobody against", source = "none", reported = true },
    { "t10", unit = "s", what = "how much longer against 10", source = "longer; 0.05 s ours", band = { 0.05 } },
    { "t50", unit = "s", what = "how much longer against 50 than against 10", source = "longer; 0.05 s ours", band = { 0.05 } },
    { "t100", unit = "s", what = "how much longer against 100 than against 50", source = "longer; 0.05 s ours", band = { 0.05 } },
    { "arrived", what = "people of the hundred who got through within ten minutes, the fewest",
      source = "all 100; ten minutes ours", band = { 100, 100 } },
  },
  pictures = { r50 = { "eastward.png", "density.png" } },
}
