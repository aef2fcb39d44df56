local measure = require "measure"

return claim {
  id = "6-7-without", title = "The Tawaf without forces: the same trend",
  source = "Kim et al. 2014, section 5",
  text = "The same pilgrims, who only avoid each other. Speeds by region fall in the same way towards and past the "
    .. "start line, so that the trend is no evidence for forces: it comes from the stop at the line.",
  held_out = measure.tawaf,
  runs = { without = measure.tawaf_run { set = { ["forces.enabled"] = false } } },
  quick = false,
  null = { text = "nobody slows down for the greeting past the line",
    runs = { without = measure.tawaf_run { duration = 100, set = { ["groups.pilgrims.memory.greets"] = false } } } },
  measure = function(run)
    local r = run.without.summary.regions
    return {
      R1 = r.R1, R7 = r.R7, others = math.min(r.R2, r.R3, r.R4, r.R5, r.R6),
      slow = math.min(r.R2, r.R3, r.R4, r.R5, r.R6) - math.max(r.R1, r.R7),
    }
  end,
  expect = {
    { "slow", unit = "m/s", what = "the slowest of R2 to R6 above both R1 and R7", source = "> 0", band = { 0 } },
    { "R1", unit = "m/s", what = "R1", reported = true }, { "R7", unit = "m/s", what = "R7", reported = true },
    { "others", unit = "m/s", what = "the slowest of R2 to R6", reported = true },
  },
  pictures = { without = { "regions.png" } },
}
