local masses = { 2, 8, 25, 60 }           -- kg, of a block
local strengths = { 80, 300, 1200, 5000 } -- N, of the bond between two blocks

local function name_of(mass, strength) return string.format("m%02.0f_b%04.0f", mass, strength) end

local runs, null_runs, expect, broken, through = {}, {}, {}, {}, {}
for i = 1, #masses do
  for k = 1, #strengths do
    local m, b = masses[i], strengths[k]
    local name = name_of(m, b)
    runs[name] = { scene = "../wall-breaking.yaml", seeds = 3, duration = 60,
      set = { ["bodies.0.shape.blocks.block_mass"] = m, ["bodies.0.shape.blocks.bond"] = b } }
    if k == 1 then null_runs[name] = { set = { ["forces.enabled"] = false } } end
    if k == #strengths then null_runs[name] = { set = { ["bodies.0.shape.blocks.bond"] = strengths[1] } } end
    expect[#expect + 1] = { "broken_" .. name, reported = true,
      what = string.format("share of bonds broken, blocks of %g kg, bonds of %g N", m, b) }
    expect[#expect + 1] = { "through_" .. name, reported = true,
      what = string.format("people who got through, blocks of %g kg, bonds of %g N", m, b) }
    broken[#broken + 1] = { m, b, "broken_" .. name }
    through[#through + 1] = { m, b, "through_" .. name }
  end
end
expect[#expect + 1] = { "weak", what = "share of bonds broken of the weakest bonds, mean over the masses",
  source = "breaks (Fig. 2); 0.2 is ours", band = { 0.2, 1 } }
expect[#expect + 1] = { "strong", what = "the same of the strongest bonds", source = "holds (Fig. 7); 0.02 is ours",
  band = { 0, 0.02 } }
expect[#expect + 1] = { "rises", what = "strengths of which no smaller share breaks than of the one before",
  source = "ours", band = { 0, 0 } }

return claim {
  id = "3m", title = "Which walls break: a map over the mass of the blocks and the strength of the bonds",
  source = "Kim et al. 2014, Figs. 2 and 7: three points of it",
  text = "The wall of 200 glued blocks and the crowd of 1200 people of claim 3, for a minute. Bonds that are weak "
    .. "break whatever the blocks weigh, strong ones hold; what holds lets people through only where it is light "
    .. "enough to be pushed aside.",
  level = "keen",
  held_out = "all cells of the map but those of claim 3, on which the throng's push and waiting were chosen",
  runs = runs, quick = false,
  null = {
    text = "forces off with the weakest bonds, and those in place of the strongest", runs = null_runs, seeds = 1,
  },
  measure = function(run)
    local out, shares = {}, {}
    for k = 1, #strengths do
      local sum = 0
      for i = 1, #masses do
        local name = name_of(masses[i], strengths[k])
        local bonds = run[name].summary.bonds
        local share = bonds.broken / (bonds.broken + bonds.held)
        out["broken_" .. name], out["through_" .. name] = share, 1200 - run[name].summary.agents
        sum = sum + share / #masses
      end
      shares[k] = sum
    end
    out.weak, out.strong, out.rises = shares[1], shares[#shares], 0
    for k = 2, #shares do
      if shares[k] >= shares[k - 1] and shares[k - 1] > 0 then out.rises = out.rises + 1 end
    end
    return out
  end,
  expect = expect,
  tried = {
    "Of bonds of 5000 N, blocks of 8 kg lose 1, 3 and 6 % with seeds 101 to 103, those of 25 kg 0, 5 and 4 %. The "
      .. "paper does not say how strong its glue is.",
  },
  plots = {
    { name = "broken", title = "Share of the bonds that broke within a minute",
      x = "mass of a block (kg)", y = "strength of a bond (N)", z = "share of bonds", map = broken },
    { name = "through", title = "People of 1200 who got through within a minute",
      x = "mass of a block (kg)", y = "strength of a bond (N)", z = "people", map = through },
  },
}
