local measure = require "measure"

return claim {
  id = "R6", title = "RiMEA 6: round a corner",
  source = "RiMEA guideline, test 6",
  text = "Twenty people turn left at the corner of a corridor of 2 m. All get round it, and none passes through a "
    .. "wall.",
  level = "normal", held_out = measure.walking_law,
  runs = {
    corner = { scene = "../rimea-06.yaml", seeds = "101-110" }, fine = { scene = "../rimea-06.yaml", dt = 0.01, seeds = "101-110" },
    coarse = { scene = "../rimea-06.yaml", dt = 0.1, seeds = "101-110" },
  },
  null = { text = "the corridor's inner corner cut off by half a metre",
    set = { ["walls.0.line.5.0"] = 9.5, ["walls.0.line.5.1"] = 2.5 } },
  measure = function(run)
    local function walls(name)
      return measure.crossings(run[name].summary.probes, "wall_")
    end
    local function round(name) return run[name].summary.probes.corner.forward end
    return {
      round = round("corner"), round_fine = round("fine"), round_coarse = round("coarse"),
      walls = walls("corner"), walls_fine = walls("fine"), walls_coarse = walls("coarse"),
      last = run.corner.summary.probes.corner.last,
    }
  end,
  expect = {
    { "round", what = "people who get round the corner, dt 0.05 s", source = "all 20", band = { 20, 20 } },
    { "round_fine", what = "the same, dt 0.01 s", source = "all 20; other dt ours", band = { 20, 20 } },
    { "round_coarse", what = "the same, dt 0.1 s", source = "all 20; other dt ours", band = { 20, 20 } },
    { "walls", what = "times that the middle of a person came within 0.1 m of a wall, dt 0.05 s",
      source = "no wall crossed; 0.1 m ours", band = { 0, 0 } },
    { "walls_fine", what = "the same, dt 0.01 s", source = "no wall crossed; 0.1 m ours", band = { 0, 0 } },
    { "walls_coarse", what = "the same, dt 0.1 s", source = "no wall crossed; 0.1 m ours", band = { 0, 0 } },
    { "last", unit = "s", what = "when the last is round it, dt 0.05 s", source = "none", reported = true },
  },
  pictures = { corner = { "paths.png", "corner.png" } },
}
