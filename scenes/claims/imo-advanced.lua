local measure = require "measure"

-- Cases of a room that a hundred people leave by an exit of a metre.
local CASES = {
  { "calm", "calm people", {} },
  { "normal", "normal people", { ["groups.people.set.haste"] = "normal" } },
  { "keen", "people in a hurry", { ["groups.people.set.haste"] = "keen" } },
  { "older", "calm and slower people, 0.97 m/s", { ["groups.people.set.speed"] = "normal(0.97, 0.19, 0.5, 1.6)" } },
}
local runs, quick, short, expect = {}, {}, {}, {}
for i = 1, #CASES do
  local name = CASES[i][1]
  runs[name] = { scene = "../room-exit.yaml", seeds = "101-150", set = CASES[i][3] }
  quick[name], short[name] = { seeds = 2 }, { duration = 30 }
  expect[i] = { name, unit = "s", what = "until the last is out, " .. CASES[i][2], source = "none", reported = true }
end
expect[#expect + 1] = { "out", what = "people who got out, the fewest of all cases", source = "all; no threshold of time",
  band = { 100, 100 } }

return claim {
  id = "I50", title = "IMO, advanced analysis: fifty runs of each of four cases",
  source = "IMO MSC.1/Circ.1533, advanced analysis",
  text = "Each case is run fifty times; what counts is the time that 95 % of the runs stay below, and of these the worst "
    .. "of the cases. Shown of a room, as an example.",
  level = "calm", held_out = measure.walking_law,
  runs = measure.calm(runs, "people"), quick = quick,
  null = { text = "runs that end after 30 s", runs = short },
  measure = function(run)
    local out, people = {}, {}
    for i = 1, #CASES do
      local exit = run[CASES[i][1]].summary.probes.exit
      out[CASES[i][1]], people[i] = exit.last, exit.forward
    end
    out.out = measure.least(people)
    return out
  end,
  expect = expect,
  pictures = { normal = { "exit.png" } },
}
