local measure = require "measure"

local FIGURES = { R1 = 0.64, R2 = 0.76, R3 = 0.76, R4 = 0.73, R5 = 0.76, R6 = 0.78, R7 = 0.72 }

-- Difference between the least mean speed of some regions and that of another one, m/s.
local function above(regions, least, others)
  local slowest = math.huge
  for i = 1, #others do slowest = math.min(slowest, regions[others[i]]) end
  return slowest - regions[least]
end

local expect = {
  { "density", unit = "1/m2", what = "greatest density (Gaussian kernel, R = 1.5 m)", source = "7.4",
    band = { 6.7, 8 } },
  { "overlap", what = "99th percentile of overlap, share of a diameter", source = "-", band = { 0, 0.05 } },
  { "mean", unit = "m/s", what = "mean of the regions", source = "0.74", band = { 0.7, 0.8 } },
  { "first", unit = "m/s", what = "the slowest of the others above R1", source = "R1 is slowest", band = { 0 } },
  { "second", unit = "m/s", what = "the slowest of R2 to R6 above R7", source = "R7 is second", band = { 0 } },
  { "behind", unit = "m/s", what = "R6 above R7", source = "0.06", band = { 0.02 } },
  { "fastest", unit = "m/s", what = "R6 above the fastest of the others", source = "R6 is fastest", reported = true },
}
for name, speed in pairs(FIGURES) do
  expect[#expect + 1] = { name, unit = "m/s", what = "mean speed in region " .. name, source = speed .. "",
    band = { speed - 0.08, speed + 0.08 } }
end

return claim {
  id = "6-7", title = "The Tawaf: densities, and speeds by region",
  source = "Kim et al. 2014, Figs. 11, 12 and 14; regions after Koshak and Fouda 2008",
  text = "35,000 pilgrims circle the Kaaba for ten minutes; the last five are measured. The region past the start "
    .. "line is the slowest, the one before it the second.",
  calibrated = measure.tawaf,
  runs = { tawaf = { scene = "../tawaf.yaml", seeds = 3, first = true,
    set = { ["heatmap.from"] = 300, ["probes.fields.from"] = 300 } } },
  quick = { tawaf = { seeds = 1, duration = 100, set = { ["heatmap.from"] = 60, ["probes.fields.from"] = 60 } } },
  measure = function(run)
    local summary = run.tawaf.summary
    local r, list = summary.regions, {}
    for i = 1, 7 do list[i] = r["R" .. i] end
    return {
      R1 = r.R1, R2 = r.R2, R3 = r.R3, R4 = r.R4, R5 = r.R5, R6 = r.R6, R7 = r.R7,
      mean = measure.mean(list), first = above(r, "R1", { "R2", "R3", "R4", "R5", "R6", "R7" }),
      second = above(r, "R7", { "R2", "R3", "R4", "R5", "R6" }), behind = r.R6 - r.R7,
      fastest = r.R6 - math.max(r.R1, r.R2, r.R3, r.R4, r.R5, r.R7),
      density = summary.probes.fields.density_max, overlap = summary.overlap_p99,
    }
  end,
  expect = expect,
  pictures = { tawaf = { "regions.png", "density.png", "fields.png" } },
}
