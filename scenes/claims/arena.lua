local measure = require "measure"

return claim {
  id = "A", title = "An arena of 5,000 people and four exits",
  source = "four exits of 2.4 m: 275 s by 1.92 b, 381 s by 82 people per metre and minute (Green Guide), 451 s by SFPE with "
    .. "effective width",
  text = "Everybody leaves by the nearest of four exits, 2.4 m wide, one in the middle of each side of 60 by 40 m.",
  level = "normal", held_out = measure.walking_law,
  runs = { arena = { scene = "../arena.yaml", seeds = 3, first = true } },
  quick = { arena = { seeds = 1 } },
  null = measure.by_orca("people"),
  measure = function(run)
    local summary = run.arena.summary
    local out, sum = { cleared = summary.danger.clearance_s or 700, left = 5000 - summary.agents }, 0
    for _, exit in ipairs { "south", "north", "west", "east" } do
      sum = sum + summary.probes[exit].flow / 2.4
    end
    out.flow = sum / 4
    return out
  end,
  expect = {
    { "cleared", unit = "s", what = "when the last is out", source = "275 to 451", band = { 275, 450 } },
    { "flow", unit = "1/(m s)", what = "people through an exit per second and metre, mean of the four",
      source = "1.15 to 1.89; ours: from 1.2", band = { 1.2, 1.9 } },
    { "left", what = "people who got out", source = "5000", band = { 5000, 5000 } },
  },
  tried = { "The exits pass 2.3 per metre and second, for the reason that W names." },
  pictures = { arena = { "density.png", "south.png" } },
}
