local measure = require "measure"

local FIGURES = { R1 = 0.64, R2 = 0.76, R3 = 0.76, R4 = 0.73, R5 = 0.76, R6 = 0.78, R7 = 0.72 }

-- Difference between the least mean speed of some regions and that of another one, m/s.
local function above(regions, least, others)
  local slowest = math.huge
  for i = 1, #others do slowest = math.min(slowest, regions[others[i]]) end
  return slowest - regions[least]
end

local expect = {
  { "density", unit = "1/m2", what = "greatest density as in Fig. 12: Gaussian of R = 1.5 m on a grid of 0.2 m, R read "
    .. "as its standard deviation", source = "7.4; band ours", band = { 6.7, 8 } },
  { "density_narrow", unit = "1/m2", what = "the same, R read as in exp(-d2 / R2)", source = "7.4, if so read",
    reported = true },
  { "density_own", unit = "1/m2", what = "greatest density of the whole run by the measure of all other pages, R = 1 m "
    .. "in exp(-d2 / R2), within walls", source = "not comparable with 7.4", reported = true },
  { "overlap", what = "99th percentile of overlap, share of a depth", source = "ours", band = { 0, 0.05 } },
  { "mean", unit = "m/s", what = "mean of the regions", source = "0.74; band ours", band = { 0.7, 0.8 } },
  { "first", unit = "m/s", what = "the slowest of the others above R1", source = "R1 is slowest: > 0", band = { 0 } },
  { "second", unit = "m/s", what = "the slowest of R2 to R6 above R7", source = "R7 is second: > 0", band = { 0 } },
  { "behind", unit = "m/s", what = "R6 above R7", source = "0.06; band ours", band = { 0.02 } },
  { "fastest", unit = "m/s", what = "R6 above the fastest of the others", source = "R6 is fastest: > 0", band = { 0 } },
}
for name, speed in pairs(FIGURES) do
  expect[#expect + 1] = { name, unit = "m/s", what = "mean speed in region " .. name, source = speed .. "; band ours",
    band = { speed - 0.08, speed + 0.08 } }
end

return claim {
  id = "6-7", title = "The Tawaf: densities, and speeds by region",
  source = "Kim et al. 2014, Figs. 11, 12 and 14; regions after Koshak and Fouda 2008",
  text = "35,000 pilgrims circle the Kaaba; the last half of the run is measured. The region past the start line, R1, "
    .. "is the slowest, the one before it, R7, the second, and R6 the fastest. The stop at the line makes R1 and R7 "
    .. "slow; forces make no difference to these figures (6-7-without).",
  calibrated = measure.tawaf,
  runs = { tawaf = measure.tawaf_run { seeds = 3 } },
  quick = { tawaf = measure.tawaf_run { seeds = 1, duration = 100 } },
  null = { text = "nobody slows down for the greeting past the line",
    runs = { tawaf = measure.tawaf_run { duration = 100, set = { ["groups.pilgrims.memory.greets"] = false } } },
    seeds = 1 },
  measure = function(run)
    local summary = run.tawaf.summary
    local r, list = summary.regions, {}
    for i = 1, 7 do list[i] = r["R" .. i] end
    return {
      R1 = r.R1, R2 = r.R2, R3 = r.R3, R4 = r.R4, R5 = r.R5, R6 = r.R6, R7 = r.R7,
      mean = measure.mean(list), first = above(r, "R1", { "R2", "R3", "R4", "R5", "R6", "R7" }),
      second = above(r, "R7", { "R2", "R3", "R4", "R5", "R6" }), behind = r.R6 - r.R7,
      fastest = r.R6 - math.max(r.R1, r.R2, r.R3, r.R4, r.R5, r.R7),
      density = summary.probes.fields.density_max, density_narrow = summary.probes.narrow.density_max,
      density_own = summary.density_max, overlap = summary.overlap_p99,
    }
  end,
  expect = expect,
  pictures = { tawaf = { "regions.png", "density.png", "fields.png" } },
  tried = {
    "R6 is not the fastest, and no faster than R7: people who leave by a gate drawn at random cross the stream there, "
      .. "some of them against it. When they left by the nearest gate, R6 had 0.775 and R7 0.725 m/s, and R2 to R6 "
      .. "differed by some 0.01 m/s, as nothing here slows people in R2 to R5, while people come in at R6. On the Mataf "
      .. "people pray behind the Maqam Ibrahim, greet the Yemeni corner and slow down along the Hateem; we know no "
      .. "figures of how many do, and how long, nor where the paper's people come in",
    "Without forces R6 was the fastest by 0.004 m/s; contacts carry the jam past the line back through R7 into R6",
  },
}
