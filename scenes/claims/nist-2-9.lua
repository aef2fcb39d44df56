local measure = require "measure"

return claim {
  id = "N2.9", title = "NIST 2.9: a party keeps together",
  source = "NIST TN 1822, test 2.9, as implemented by the verification notebooks of JuPedSim",
  text = "Four people who walk at 1.25 m/s and one who walks at 0.5 m/s leave a room together, past ten others who walk at "
    .. "0.2 m/s. The first and the last of the party are out within 10 s.",
  level = "calm", held_out = measure.walking_law,
  runs = measure.calm({ room = { scene = "../slow-group.yaml", seeds = "101-110" } }, "quick", "slow", "others"),
  quick = { room = { seeds = 10 } },
  null = { text = "five people who do not walk as a party",
    set = { ["groups.quick.behaviour"] = "walker.lua", ["groups.slow.behaviour"] = "walker.lua" } },
  measure = function(run)
    local party = run.room.summary.probes.party
    return { people = party.forward - party.back, apart = party.last - party.first, last = party.last }
  end,
  expect = {
    { "people", what = "people of the party who get out", source = "all 5", band = { 5, 5 } },
    { "apart", unit = "s", what = "from the first to the last of them", source = "10 or less", band = { 0, 10 } },
    { "last", unit = "s", what = "until the last is out", source = "none", reported = true },
  },
  pictures = { room = { "paths.png" } },
}
