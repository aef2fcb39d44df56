local measure = require "measure"

-- The corridor's two legs are so many metres longer.
local function corridor(more)
  return { ["walls.0.line.2.1"] = 6 + more, ["walls.0.line.3.1"] = 6 + more, ["walls.1.line.2.1"] = 4 + more,
    ["walls.1.line.3.1"] = 4 + more, ["probes.by_corridor.flow.0.1"] = 6 + more, ["probes.by_corridor.flow.1.1"] = 4 + more }
end

return claim {
  id = "R14", title = "RiMEA 14: stairs, or a longer way on one storey",
  source = "RiMEA 4.1.1, test 14, by notes of it: it is to be documented which way is taken",
  text = "People go from one place of a storey to another: down a stair, along the ground and up a stair, or along a corridor of "
    .. "the storey. By stairs the way is 26 m long. They take the way that takes less time: the corridor if it is 34 m long, as "
    .. "people are slow on stairs, and the stairs if it is 54 m.",
  level = "normal", held_out = measure.walking_law,
  runs = { short = { scene = "../rimea-14.yaml", seeds = "101-110" },
    long = { scene = "../rimea-14.yaml", seeds = "101-110", set = corridor(10) } },
  quick = { short = { seeds = 3 }, long = { seeds = 3 } },
  null = { text = "a corridor of 54 m in both runs", set = corridor(10) },
  measure = function(run)
    local function probes(name) return run[name].summary.probes end
    local out = { short = probes("short").by_stairs.forward, long = probes("long").by_stairs.forward }
    out.all = out.short + probes("short").by_corridor.forward + out.long + probes("long").by_corridor.forward
    return out
  end,
  expect = {
    { "short", what = "people of 10 who take the stairs, corridor of 34 m", source = "the faster way; ours", band = { 0, 1 } },
    { "long", what = "people of 10 who take the stairs, corridor of 54 m", source = "the faster way; ours", band = { 9, 10 } },
    { "all", what = "people who get through, of both runs", source = "all", band = { 20, 20 } },
  },
}
