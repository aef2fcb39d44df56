local measure = require "measure"

return claim {
  id = "R10", title = "RiMEA 10: assigned exits",
  source = "RiMEA guideline, test 10; IMO MSC.1/Circ.1533, test 10",
  text = "23 people in twelve rooms on a corridor: each leaves by the exit that was assigned, not by the nearer one.",
  level = "normal", held_out = measure.walking_law,
  runs = { rooms = { scene = "../rimea-10.yaml", seeds = "101-110" } },
  null = { text = "everybody assigned to the main exit", set = { ["groups.to_secondary.set.goal"] = "main" } },
  measure = function(run)
    local probes = run.rooms.summary.probes
    return {
      main = probes.main_right.forward, secondary = probes.secondary_right.forward,
      wrong = probes.main_wrong.passages + probes.secondary_wrong.passages,
      last = math.max(probes.main_right.last, probes.secondary_right.last or 0),
    }
  end,
  expect = {
    { "main", what = "people of rooms 1 to 4 and 7 to 10 who leave by the main exit", source = "all 15",
      band = { 15, 15 } },
    { "secondary", what = "people of the other rooms who leave by the secondary exit", source = "all 8", band = { 8, 8 } },
    { "wrong", what = "people at the other exit", source = "nobody", band = { 0, 0 } },
    { "last", unit = "s", what = "until the last has left", source = "none", reported = true },
  },
  pictures = { rooms = { "paths.png" } },
}
