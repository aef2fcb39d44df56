local measure = require "measure"

-- Displacement of the foremost person as a share of that of the pushed one.
local function kept(run)
  local peak = run.csv("row").peak
  return peak[5] / peak[1]
end

-- Nobody of the row passes on what their feet resist of a push (equation 9): contacts alone move them.
local alone = {}
for person = 1, 5 do alone["groups.p" .. person .. ".set.absorb"] = 0 end

return claim {
  id = "P1", title = "A push travels along a row of people",
  source = "Feldmann and Adrian 2023, five in a row, 0.32 to 0.42 m apart, the last one pushed",
  text = "With nobody in front the push travels at 2.6 m/s and nobody is moved less than the one who was pushed. The shove "
    .. "goes over time as the measured one; its greatest force, 2200 N, is chosen so that the five are moved about as far as "
    .. "measured in the mean, 0.57 m; the measured one has 2970 N. Held out is who is moved how far. Contacts alone carry a "
    .. "push as fast, but it dies away.",
  level = "normal",
  calibrated = "the shove's greatest force was chosen on the mean of the five displacements; the share of a push that feet "
    .. "hold, and the delay with which pushes are passed on, were chosen on this row of people without torsos",
  runs = {
    free = { scene = "../push-row.yaml", seeds = 1 }, fine = { scene = "../push-row.yaml", dt = 0.01, seeds = 1 },
    coarse = { scene = "../push-row.yaml", dt = 0.05, seeds = 1 },
  },
  null = { text = "nobody passes on what their feet resist (equation 9): contacts alone", set = alone },
  measure = function(run)
    local free = run.free.csv("row").peak
    return {
      front = measure.front(run.free.csv("row")), front_fine = measure.front(run.fine.csv("row")),
      front_coarse = measure.front(run.coarse.csv("row")),
      kept = (kept(run.free) + kept(run.fine) + kept(run.coarse)) / 3, moved = measure.mean(free),
      p1 = free[1], p2 = free[2], p3 = free[3], p4 = free[4], p5 = free[5],
    }
  end,
  expect = {
    { "front", unit = "m/s", what = "how fast the push travels, dt 0.02 s", source = "2.6", band = { 2.1, 3.1 } },
    { "front_fine", unit = "m/s", what = "the same, dt 0.01 s", source = "2.6", band = { 2.1, 3.1 } },
    { "front_coarse", unit = "m/s", what = "the same, dt 0.05 s", source = "2.6", band = { 2.1, 3.1 } },
    { "kept", what = "displacement of the foremost over that of the one who was pushed, mean of the three",
      source = "1.2; ours: from 0.9", band = { 0.9 } },
    { "moved", unit = "m", what = "mean of the five displacements, which set the shove", source = "0.57",
      reported = true },
    measure.expected("p1", "m", "greatest displacement, first", 0.44, 0.25),
    measure.expected("p2", "m", "greatest displacement, second", 0.50, 0.25),
    measure.expected("p3", "m", "greatest displacement, third", 0.65, 0.25),
    measure.expected("p4", "m", "greatest displacement, fourth", 0.70, 0.25),
    measure.expected("p5", "m", "greatest displacement, fifth", 0.54, 0.25),
  },
  plots = { { name = "peaks", title = "Greatest displacement along the row, the pushed one first",
    x = "person", y = "greatest displacement (m)",
    { "Jostle, nobody in front", figures = { { 1, "p1" }, { 2, "p2" }, { 3, "p3" }, { 4, "p4" }, { 5, "p5" } } },
    { "measured, nobody in front", points = { { 1, 0.44 }, { 2, 0.50 }, { 3, 0.65 }, { 4, 0.70 }, { 5, 0.54 } } } } },
  tried = { "The push travels as fast as contacts carry it: the one who is pushed reaches 1 m/s and more and closes the gap "
    .. "ahead within 0.1 s, while real people were moved at 0.7 m/s. The whole measured force moves the five by 0.84 m in the "
    .. "mean; with twice the damping of the feet (5 1/s) it is 0.48 m, but then it dies away along the row.",
    "Deeper torsos leave less of a gap to close: 0.27 m deep, the same shove travels at 4.1 to 4.4 m/s, and 0.28 m deep at 4.6 "
    .. "to 4.9. A weaker one travels more slowly, and could move them as far if feet did not stop them so hard: who is pushed on, "
    .. "while those ahead throw it back harder, is bounded backwards alone (12), and stops with the time constant of plans, "
    .. "0.05 s. Where damping alone brakes it, 1700 N moves the five by 0.53 to 0.59 m at steps from 0.00625 to 0.05 s, and the "
    .. "push travels at 3.2 to 3.4 m/s (that of P2 at 3.0), but the foremost is moved 0.76 times as far as the one who is "
    .. "pushed, and fewer rows press on the wall of claim 3." },
  pictures = { free = { "row.png", "paths.png" } },
}
