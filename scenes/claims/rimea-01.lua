local measure = require "measure"

return claim {
  id = "R1", title = "RiMEA 1: keeping a speed along a corridor",
  source = "RiMEA guideline, test 1",
  text = "One person walks 40 m along a corridor of 2 m at 1.33 m/s. That takes 26 to 34 s.",
  level = "normal", held_out = measure.walking_law,
  runs = {
    walk = { scene = "../rimea-01.yaml", seeds = 1 }, fine = { scene = "../rimea-01.yaml", dt = 0.01, seeds = 1 },
    coarse = { scene = "../rimea-01.yaml", dt = 0.2, seeds = 1 },
  },
  null = { text = "a person who is a fifth slower, at 1.06 m/s", set = { ["groups.person.set.speed"] = 1.06 } },
  measure = function(run)
    local function time(name) return run[name].summary.probes.corridor.mean end
    local probes = run.walk.summary.probes
    return {
      time = time("walk"), time_fine = time("fine"), time_coarse = time("coarse"),
      walls = probes.upper.passages + probes.lower.passages,
    }
  end,
  expect = {
    { "time", unit = "s", what = "time for 40 m, dt 0.05 s", source = "26 to 34", band = { 26, 34 } },
    { "time_fine", unit = "s", what = "the same, dt 0.01 s", source = "26 to 34; other dt ours", band = { 26, 34 } },
    { "time_coarse", unit = "s", what = "the same, dt 0.2 s", source = "26 to 34; other dt ours", band = { 26, 34 } },
    { "walls", what = "times that it came within 0.1 m of a wall", source = "ours", band = { 0, 0 } },
  },
  pictures = { walk = { "paths.png" } },
}
