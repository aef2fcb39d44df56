local measure = require "measure"

local ends = function(run) return measure.mean(run.csv("row").dx) end

local still = {}
for person = 1, 5 do still["groups.p" .. person .. ".set.step_back"] = 0 end

return claim {
  id = "P1b", title = "After a push people step back",
  source = "Feldmann and Adrian 2023, five in a row, 0.32 to 0.42 m apart, the last one pushed",
  text = "The five of claim P1, whom the push moves by 0.57 m in the mean, go back towards where they stood: 3 to 4 s after "
    .. "they were farthest, 0.26 m are left.",
  level = "normal",
  calibrated = "the speed of steps back was chosen on it, in view of a row at a wall that goes back all the way",
  runs = {
    free = { scene = "../push-row.yaml", seeds = 1 }, fine = { scene = "../push-row.yaml", dt = 0.01, seeds = 1 },
    coarse = { scene = "../push-row.yaml", dt = 0.05, seeds = 1 },
  },
  null = { text = "nobody steps back", set = still },
  measure = function(run)
    local left = run.free.csv("row").dx
    return {
      left = ends(run.free), left_fine = ends(run.fine), left_coarse = ends(run.coarse),
      e1 = left[1], e2 = left[2], e3 = left[3], e4 = left[4], e5 = left[5],
    }
  end,
  expect = {
    { "left", unit = "m", what = "displacement at 5 s, mean of the five, dt 0.02 s",
      source = "0.26, mean of the last second", band = { 0.195, 0.325 } },
    { "left_fine", unit = "m", what = "the same, dt 0.01 s", source = "0.26", band = { 0.195, 0.325 } },
    { "left_coarse", unit = "m", what = "the same, dt 0.05 s", source = "0.26", band = { 0.195, 0.325 } },
    { "e1", unit = "m", what = "displacement at 5 s, first", source = "0.21", reported = true },
    { "e2", unit = "m", what = "second", source = "0.17", reported = true },
    { "e3", unit = "m", what = "third", source = "0.25", reported = true },
    { "e4", unit = "m", what = "fourth", source = "0.31", reported = true },
    { "e5", unit = "m", what = "fifth, who steps aside too", source = "0.37", reported = true },
  },
}
