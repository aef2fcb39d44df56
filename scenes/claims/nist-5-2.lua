local measure = require "measure"

return claim {
  id = "N5.2", title = "NIST 5.2: greatest flow through an exit",
  source = "NIST TN 1822, test 5.2, as implemented by the verification notebooks of JuPedSim",
  text = "A hundred people leave a room of 8 x 5 m by an exit of 1 m. No more than 1.33 people pass it in a second. "
    .. "Experiments with doors of a metre found 1.5 to 2.2; normal people and people in a hurry are shown as well.",
  level = "calm", held_out = measure.walking_law,
  runs = measure.calm({
    exit = { scene = "../room-exit.yaml", seeds = "101-110" },
    normal = { scene = "../room-exit.yaml", seeds = "101-110", set = { ["groups.people.set.haste"] = "normal" } },
    keen = { scene = "../room-exit.yaml", seeds = "101-110", set = { ["groups.people.set.haste"] = "keen" } },
  }, "people"),
  null = { text = "an exit of 1.5 m", set = { ["walls.0.line.0.1"] = 1.75, ["walls.0.line.5.1"] = 3.25,
    ["probes.exit.flow.0.1"] = 3.25, ["probes.exit.flow.1.1"] = 1.75 } },
  measure = function(run)
    local function flow(name) return run[name].summary.probes.exit.flow_all end
    return { flow = flow("exit"), normal = flow("normal"), keen = flow("keen"), people = run.exit.summary.probes.exit.forward }
  end,
  expect = {
    { "flow", unit = "1/s", what = "flow through the exit", source = "1.33 or less", band = { 0, 1.33 } },
    { "normal", unit = "1/s", what = "the same, normal people", source = "none", reported = true },
    { "keen", unit = "1/s", what = "the same, people in a hurry", source = "none", reported = true },
    { "people", what = "people who leave", source = "all 100", band = { 100, 100 } },
  },
  pictures = { exit = { "exit.png", "density.png" } },
}
