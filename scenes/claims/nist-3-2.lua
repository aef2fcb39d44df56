local measure = require "measure"

return claim {
  id = "N3.2", title = "NIST 3.2: others lead the way",
  source = "NIST TN 1822, test 3.2, as implemented by the verification notebooks of JuPedSim",
  text = "People in a hall with two exits alike see somebody make for the second one. More of them use it than where nobody "
    .. "leads.",
  level = "calm", held_out = measure.walking_law,
  runs = measure.calm({
    led = { scene = "../two-exits.yaml", seeds = "101-130" },
    alone = { scene = "../two-exits.yaml", seeds = "101-130", set = { ["groups.leader.set.premovement"] = 60 } },
  }, "people", "leader"),
  quick = { led = { seeds = 10 }, alone = { seeds = 10 } },
  null = { text = "people who do not heed which exit others choose", set = { ["groups.people.set.sway"] = 0 } },
  measure = function(run)
    local led, alone = run.led.summary.probes.east.forward, run.alone.summary.probes.east.forward
    return { more = led - alone, led = led, alone = alone }
  end,
  expect = {
    { "more", what = "how many more of 20 use the second exit", source = "more; 0.5 ours", band = { 0.5, 20 } },
    { "led", what = "people at the second exit, with somebody who leads", source = "none", reported = true },
    { "alone", what = "the same, with nobody", source = "none", reported = true },
  },
  pictures = { led = { "paths.png" } },
}
