local measure = require "measure"

local left = function(run) return measure.mean(run.csv("row").dx) end

local still = {}
for person = 1, 5 do still["groups.p" .. person .. ".set.step_back"] = 0 end

return claim {
  id = "P1b", title = "After a push people step back",
  source = "Feldmann and Adrian 2023, five in a row, the last one pushed, in the open and at a wall",
  text = "The five of claim P1, whom the push moves by 0.57 m in the mean, go back towards where they stood: 3 to 4 s after "
    .. "they were farthest, 0.26 m are left. Those of claim P2, who have a wall before them, go back all the way, and come to "
    .. "stand behind where they stood.",
  level = "normal",
  calibrated = "the speed of steps back was chosen on the row in the open, how far they lead beyond the place on the row at "
    .. "the wall",
  runs = {
    free = { scene = "../push-row.yaml", seeds = 1 }, fine = { scene = "../push-row.yaml", dt = 0.01, seeds = 1 },
    coarse = { scene = "../push-row.yaml", dt = 0.05, seeds = 1 }, wall = { scene = "../push-row-wall.yaml", seeds = 1 },
  },
  null = { text = "nobody steps back", set = still },
  measure = function(run)
    local free, wall = run.free.csv("row").dx, run.wall.csv("row").dx
    return {
      left = left(run.free), left_fine = left(run.fine), left_coarse = left(run.coarse),
      e1 = free[1], e2 = free[2], e3 = free[3], e4 = free[4], e5 = free[5],
      wall_least = measure.least(wall), wall_most = measure.most(wall),
    }
  end,
  expect = {
    { "left", unit = "m", what = "displacement at 5 s, mean of the five in the open, dt 0.02 s",
      source = "0.26, mean of the last second", band = { 0.195, 0.325 } },
    { "left_fine", unit = "m", what = "the same, dt 0.01 s", source = "0.26", band = { 0.195, 0.325 } },
    { "left_coarse", unit = "m", what = "the same, dt 0.05 s", source = "0.26", band = { 0.195, 0.325 } },
    { "e1", unit = "m", what = "displacement at 5 s, first", source = "0.21", reported = true },
    { "e2", unit = "m", what = "second", source = "0.17", reported = true },
    { "e3", unit = "m", what = "third", source = "0.25", reported = true },
    { "e4", unit = "m", what = "fourth", source = "0.31", reported = true },
    { "e5", unit = "m", what = "fifth, who steps aside too", source = "0.37", reported = true },
    { "wall_least", unit = "m", what = "where those at the wall come to stand, from where they stood: the one who stays back "
      .. "the most", source = "-0.02 to -0.13", band = { -0.13, -0.02 } },
    { "wall_most", unit = "m", what = "the one who is left farthest towards the wall", source = "-0.02 to -0.13",
      band = { -0.13, -0.02 } },
  },
  tried = { "With steps of 0.05 s the push moves the row in the open farther (0.77 m in the mean), and so more is left. A blow "
    .. "from those ahead is spread over two steps then, and the net force on the one who is pushed points back in neither; in "
    .. "shorter steps it does, and feet stop that one at once." },
}
