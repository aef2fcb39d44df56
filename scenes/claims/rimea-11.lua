local measure = require "measure"

return claim {
  id = "R11", title = "RiMEA 11: the nearer and the farther exit",
  source = "RiMEA 4.1.1, test 11",
  text = "A thousand people in one half of a hall with two doors: they prefer the nearer one, but some give it up for the "
    .. "farther one when a crowd stands before it. As they compare the times by both, the share is little above a half, and "
    .. "also if they all make for the farther door at first.",
  level = "normal", held_out = measure.walking_law,
  runs = { hall = { scene = "../rimea-11.yaml", seeds = "101-110" } },
  quick = { hall = { seeds = 1 } },
  null = { text = "people in the other half of the hall, nearer to the other door", seeds = 1, set = {
    ["places.west.polygon.0.0"] = 15, ["places.west.polygon.1.0"] = 29.7, ["places.west.polygon.2.0"] = 29.7,
    ["places.west.polygon.3.0"] = 15 } },
  measure = function(run)
    local near, far = run.hall.summary.probes.near, run.hall.summary.probes.far
    local by_near, by_far = near.forward - near.back, far.forward - far.back -- some people step back
    return {
      out = by_near + by_far, near = by_near / (by_near + by_far),
      sooner = far.first and far.first - near.first, last = math.max(near.last, far.last or 0),
    }
  end,
  expect = {
    { "out", what = "people who got out", source = "all 1000", band = { 1000, 1000 } },
    { "near", what = "share of them by the nearer door", source = "more than half, not all; 0.9 ours", band = { 0.5, 0.9 } },
    { "sooner", unit = "s", what = "how much earlier the first is through the nearer door", source = "ours",
      band = { 0.05 } },
    { "last", unit = "s", what = "until the last is out", source = "none", reported = true },
  },
  pictures = { hall = { "density.png", "near.png", "far.png" } },
}
