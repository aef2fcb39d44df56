local measure = require "measure"

return claim {
  id = "I5", title = "IMO 5: each moves at its time",
  source = "IMO MSC.1/Circ.1533, test 5, as implemented by the verification notebooks of JuPedSim",
  text = "Ten people in a room of 8 x 5 m begin to move at times of their own, even between 10 and 100 s.",
  level = "calm", held_out = measure.walking_law,
  runs = measure.calm({ room = { scene = "../premovement.yaml", seeds = "101-110" } }, "people"),
  quick = { room = { seeds = 3 } },
  null = { text = "times of half the spread, even between 32.5 and 77.5 s",
    set = { ["groups.people.set.premovement"] = "uniform(32.5, 77.5)" } },
  measure = function(run)
    local waiting = run.room.summary.probes.waiting
    return { people = waiting.passages, least = waiting.least, greatest = waiting.greatest,
      apart = measure.deviation(run.room.csv("waiting").transit) }
  end,
  expect = {
    { "people", what = "people who began to move", source = "all 10", band = { 10, 10 } },
    { "least", unit = "s", what = "the first of them", source = "10 or more; upper edge ours", band = { 10, 55 } },
    { "greatest", unit = "s", what = "the last of them", source = "100 or less; lower edge ours", band = { 55, 100.1 } },
    { "apart", unit = "s", what = "standard deviation of their times", source = "26.0, even over 90 s; band ours",
      band = { 18, 34 } },
  },
  pictures = { room = { "waiting.png" } },
}
