local measure = require "measure"

-- Greatest correlation of the densities in two slices of the crowd, 2 m apart, over delays of 0.5 to 4 s: a measure
-- of waves that travel from the first to the second. Trends are removed, as the densities of a crowd that fills up
-- correlate anyway. Without waves it is about 0.2, by chance.
local function reaches(from, to)
  local best, first, second = -1, measure.detrended(from.density), measure.detrended(to.density)
  for lag = 2, 16 do
    best = math.max(best, measure.correlation(first, second, lag))
  end
  return best
end

local function run(scene, seeds) return { scene = "../" .. scene .. ".yaml", seeds = seeds, first = true } end

return claim {
  id = "3", title = "Walls that break, that turn, and that stay",
  source = "Kim et al. 2014, Figs. 2 and 7",
  text = "1200 people stop before a wall of 200 glued blocks, press, and carry its pieces away. With glue that holds, "
    .. "the wall turns as a whole and a gap lets them out; too heavy, it hardly moves, and room runs through the "
    .. "crowd in waves.",
  level = "keen",
  calibrated = "the throng's push, 80 N for each metre a second, and how long it waits, were chosen on all of its "
    .. "figures, and so were the mass of the blocks and the strength of their bonds",
  runs = { breaking = run("wall-breaking", 3), tight = run("wall-tight", 3), heavy = run("wall-heavy", 3) },
  quick = { breaking = { duration = 60 }, tight = { seeds = 1 }, heavy = { duration = 90 } },
  null = { text = "forces off", set = { ["forces.enabled"] = false }, seeds = 1 },
  measure = function(run)
    local breaking, tight, heavy = run.breaking.summary.bonds, run.tight.summary.bonds, run.heavy.summary.bonds
    local near, far = run.heavy.csv("behind_6"), run.heavy.csv("behind_8")
    return {
      front = breaking.front_speed, rows = breaking.rows_pressing, pieces = breaking.pieces,
      out = 1200 - run.breaking.summary.agents,
      tight_broken = tight.broken, tight_out = 1200 - run.tight.summary.agents, tight_turned = tight.turned,
      heavy_broken = heavy.broken, heavy_moved = heavy.moved, backward = reaches(near, far),
      forward = reaches(far, near),
    }
  end,
  expect = {
    { "front", unit = "m/s",
      what = "breaking: mean speed of the front row in the second before it first touches the wall",
      source = "stops", band = { 0, 0.1 } },
    { "rows", what = "rows that press when the first bond breaks, each at least half as many people as the first",
      source = ">= 3", band = { 3 } },
    { "pieces", what = "pieces in the end", source = "broken", band = { 2 } },
    { "out", what = "people who got through", reported = true },
    { "tight_broken", what = "tight: bonds broken", source = "0", band = { 0, 0 } },
    { "tight_out", what = "people who got out", source = "> 0", band = { 1 } },
    { "tight_turned", unit = "deg", what = "turned by", source = "turns", reported = true },
    { "heavy_broken", what = "heavy: bonds broken", source = "0", band = { 0, 0 } },
    { "heavy_moved", unit = "m", what = "moved by, less than a block", source = "hardly", band = { 0, 0.4 } },
    { "backward", what = "density 8 m behind the wall follows that at 6 m: greatest correlation",
      source = "waves run back", band = { 0.4, 1 } },
    { "forward", what = "density 6 m behind follows that at 8 m", source = "and forward", band = { 0.4, 1 } },
  },
  pictures = { breaking = { "density.png" }, tight = { "density.png" }, heavy = { "density.png", "behind_6.png" } },
}
