-- Rows beside the runner's way, out of its reach, in which a person was moved by more than 5 cm.
local function secondary_rows(standing)
  local rows, count = {}, 0
  for i = 1, standing.n do
    local y = standing.y[i]
    if math.abs(y) > 0.45 and standing.peak[i] > 0.05 and not rows[math.floor(y * 100)] then
      rows[math.floor(y * 100)] = true
      count = count + 1
    end
  end
  return count
end

-- People who are driven along for more than five spacings.
local function ploughed(standing, spacing)
  local count = 0
  for i = 1, standing.n do
    if standing.peak[i] > 5 * spacing then count = count + 1 end
  end
  return count
end

local function run(spacing, block, enabled)
  return { scene = "../running-through.yaml",
    set = { ["groups.standing.spacing"] = spacing, ["groups.standing.in"] = block, ["forces.enabled"] = enabled } }
end

return claim {
  id = "1", title = "Running through a standing crowd",
  source = "Kim et al. 2014, Fig. 5",
  text = "One fast agent runs through 25 standing ones. With forces it moves many, and those push others on; "
    .. "without, people barely move.",
  level = "normal",
  calibrated = "the runner's push, 300 N for each metre a second, was chosen on it",
  runs = {
    s50 = run(0.5, "block_50", true), s50_without = run(0.5, "block_50", false),
    s55 = run(0.55, "block", true), s55_without = run(0.55, "block", false),
    s60 = run(0.6, "block_60", true), s60_without = run(0.6, "block_60", false),
  },
  null = { text = "forces off in the runs with forces too", set = { ["forces.enabled"] = false } },
  measure = function(run)
    local function mean(name) return run[name].summary.probes.standing.peak_mean end
    return {
      ratio_50 = mean("s50") / mean("s50_without"), ratio_55 = mean("s55") / mean("s55_without"),
      ratio_60 = mean("s60") / mean("s60_without"),
      without_50 = mean("s50_without"), ploughed_50 = ploughed(run.s50.csv("standing"), 0.5),
      without_55 = mean("s55_without"), without_60 = mean("s60_without"),
      rows = math.min(secondary_rows(run.s50.csv("standing")), secondary_rows(run.s55.csv("standing")),
        secondary_rows(run.s60.csv("standing"))),
    }
  end,
  expect = {
    { "ratio_50", what = "mean of the greatest displacements with forces over that without, spacing 0.50 m", source = "moves them; band ours",
      band = { 1.8 } },
    { "ratio_55", what = "the same, spacing 0.55 m", source = "moves them; band ours", band = { 1.8 } },
    { "ratio_60", what = "the same, spacing 0.60 m", source = "moves them; band ours", band = { 1.8 } },
    { "without_55", unit = "m", what = "mean of the greatest displacements without forces, spacing 0.55 m", source = "barely move; band ours",
      band = { 0, 0.12 } },
    { "without_60", unit = "m", what = "the same, spacing 0.60 m", source = "barely move; band ours", band = { 0, 0.12 } },
    { "without_50", unit = "m", what = "the same, spacing 0.50 m, 0.1 m between people", reported = true },
    { "ploughed_50", what = "people whom the runner drives along by more than 2.5 m, spacing 0.50 m", reported = true },
    { "rows", what = "rows out of the runner's reach that moved, least of the spacings", source = "others push on; band ours",
      band = { 2 } },
  },
  pictures = { s55 = { "paths.png", "standing.png" }, s55_without = { "paths.png" } },
}
