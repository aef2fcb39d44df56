local measure = require "measure"

local peaks = { 0.40, 0.37, 0.29, 0.19, 0.11 } -- m, the pushed one first
local names = { "first", "second", "third", "fourth", "fifth" }

-- Nobody of the row passes on what their feet resist of a push (equation 9): contacts alone move them.
local alone, expect, measured, source = {}, {}, {}, {}
expect[1] = { "front", unit = "m/s", what = "how fast the push travels", source = "3.0; ours: a fifth",
  band = measure.about(3, 0.2) }
for i = 1, #peaks do
  local name = "w" .. i
  alone["groups.p" .. i .. ".set.absorb"] = 0
  expect[i + 1] = measure.expected(name, "m", "greatest displacement, " .. names[i], peaks[i], 0.25)
  measured[i], source[i] = { i, name }, { i, peaks[i] }
end
expect[#expect + 1] = { "rises", what = "people, of those whom others pushed, who are moved no less than the one behind",
  source = "0", band = { 0, 0 } }

return claim {
  id = "P2", title = "A push along a row of people at a wall",
  source = "Feldmann and Adrian 2023, five in a row at a wall, the last one pushed",
  text = "The push travels at 3 m/s and dies away towards the wall. The shove has the greatest force and the impulse of the "
    .. "measured one. Claim P1b has how all step back then.",
  level = "normal",
  held_out = "the delay with which pushes are passed on was chosen by how fast that of P1 travels, among people without "
    .. "torsos; nothing was chosen on this row but its distance to the wall, on how far the foremost was moved",
  runs = { wall = { scene = "../push-row-wall.yaml", seeds = 1 } },
  null = { text = "nobody passes on what their feet resist (equation 9): contacts alone", set = alone },
  measure = function(run)
    local row = run.wall.csv("row")
    local out = { front = measure.front(row), rises = measure.rises(row.peak, 2) }
    for i = 1, #peaks do out["w" .. i] = row.peak[i] end
    return out
  end,
  expect = expect,
  plots = { { name = "peaks", title = "Greatest displacement along the row at a wall, the pushed one first",
    x = "person", y = "greatest displacement (m)", { "Jostle", figures = measured }, { "measured", points = source } } },
  tried = { "The distances of this row are those of P1, as its own are not known. Those in front close up to the wall, so "
    .. "that the fourth is moved by the gaps ahead of it, 0.17 and 0.1 m." },
  pictures = { wall = { "row.png", "paths.png" } },
}
