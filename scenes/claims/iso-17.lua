local measure = require "measure"

return claim {
  id = "O17", title = "ISO 17: the shorter way",
  source = "ISO 20414:2020, test 17, by notes of an open implementation",
  text = "Two ways lead from a room to its exit, one more than twice as long as the other. Nothing keeps people back on the "
    .. "shorter one, and all ten take it.",
  level = "normal", held_out = measure.walking_law,
  runs = { room = { scene = "../iso-17.yaml", seeds = "101-110" } },
  quick = { room = { seeds = 3 } },
  null = { text = "an exit to which the other way is the shorter one", set = {
    ["places.exit.polygon.0.0"] = -4, ["places.exit.polygon.1.0"] = -2, ["places.exit.polygon.2.0"] = -2,
    ["places.exit.polygon.3.0"] = -4, ["places.exit.polygon.0.1"] = 12, ["places.exit.polygon.1.1"] = 12,
    ["places.exit.polygon.2.1"] = 14, ["places.exit.polygon.3.1"] = 14 } },
  measure = function(run)
    local probes = run.room.summary.probes
    return { short = probes.short.forward, long = probes.long.forward, last = probes.short.last }
  end,
  expect = {
    { "short", what = "people who take the shorter way, of 10", source = "all 10", band = { 10, 10 } },
    { "long", what = "people who take the longer way", source = "nobody", band = { 0, 0 } },
    { "last", unit = "s", what = "until the last is on it", source = "none", reported = true },
  },
  pictures = { room = { "paths.png" } },
}
