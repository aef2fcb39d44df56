local measure = require "measure"

return claim {
  id = "I11", title = "IMO 11: jams at an exit and at the foot of a stair",
  source = "IMO MSC.1/Circ.1533, test 11, by notes of it; exit, lengths and times are ours",
  text = "150 people leave a room by an exit of 1 m, walk along a corridor of 2 m, and go up a stair of 2 m. They jam before the "
    .. "exit, and again at the foot of the stair, while they still walk in the corridor between.",
  level = "calm", held_out = measure.walking_law .. "; the time gap on stairs on a stair of 2 m",
  runs = measure.calm({ stair = { scene = "../imo-11.yaml", seeds = "101-105" } }, "people"),
  quick = { stair = { seeds = 1 } },
  null = { text = "people who are as fast on the stair as before it, and keep the time gap of level ground",
    set = { ["groups.people.set.stair_up"] = 1.547, ["walking.stair_gap_up"] = 1 } },
  measure = function(run)
    local probes = run.stair.summary.probes
    return {
      exit = probes.exit.density / probes.corridor.density, foot = probes.foot.density / probes.corridor.density,
      between = probes.corridor.speed, slow = probes.foot.speed, flow = probes.up.specific_flow, out = probes.up.forward,
    }
  end,
  expect = {
    { "exit", what = "density before the exit over that in the corridor, 10 to 40 s", source = "a jam; twice is ours", band = { 2 } },
    { "foot", what = "density at the stair's foot over that in the corridor", source = "a jam; 1.3 times is ours", band = { 1.3 } },
    { "out", what = "people who get up", source = "all 150", band = { 150, 150 } },
    { "between", unit = "m/s", what = "speed in the corridor", source = "none", reported = true },
    { "slow", unit = "m/s", what = "speed at the stair's foot", source = "none", reported = true },
    { "flow", unit = "1/(m s)", what = "flow up", source = "none: 0.88 at most (IMO)", reported = true },
  },
  pictures = { stair = { "foot.png" } },
}
