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
local function add_end(name, what)
  expect[#expect + 1] = { name, unit = "m", what = what, source = "-0.02 to -0.13", band = { -0.13, -0.02 } }
end
add_end("end_least", "where they come to stand, from where they stood: the one who stays back the most")
add_end("end_most", "the one who is left farthest towards the wall")
expect[#expect + 1] = { "rises", what = "people, of those whom others pushed, who are moved no less than the one behind",
  source = "0", band = { 0, 0 } }

return claim {
  id = "P2", title = "A push along a row of people at a wall",
  source = "Feldmann and Adrian 2023, five in a row at a wall, the last one pushed",
  text = "The push travels at 3 m/s and dies away towards the wall; then all step back, behind where they stood. The shove "
    .. "has the greatest force and the impulse of the measured one, by the scale of P1.",
  level = "normal",
  held_out = "the scale of the shove was chosen on P1, the delay with which pushes are passed on by how fast that one travels",
  runs = { wall = { scene = "../push-row-wall.yaml", seeds = 1 } },
  null = { text = "nobody passes on what their feet resist (equation 9): contacts alone", set = alone },
  measure = function(run)
    local row = run.wall.csv("row")
    local out = { front = measure.front(row), end_least = measure.least(row.dx), end_most = measure.most(row.dx),
      rises = measure.rises(row.peak, 2) }
    for i = 1, #peaks do out["w" .. i] = row.peak[i] end
    return out
  end,
  expect = expect,
  plots = { { name = "peaks", title = "Greatest displacement along the row at a wall, the pushed one first",
    x = "person", y = "greatest displacement (m)", { "Jostle", figures = measured }, { "measured", points = source } } },
  tried = { "The one at the wall has 0.08 m to it, and goes back by little more. A small push is passed on late: it travels only as "
    .. "fast as the gaps between people close." },
  pictures = { wall = { "row.png", "paths.png" } },
}
