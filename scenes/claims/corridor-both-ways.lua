local measure = require "measure"

-- Widths of corridor and entrances, cm, and the source's flow, 1/s, density, 1/m2, and speed, m/s.
local cases = {
  { "bo-360-160-160", 4.61, 1.90, 0.67 },
  { "bot-360-250-250", 4.55, 2.59, 0.55 },
}

local runs, quick, expect, pictures = {}, {}, {}, {}
for i = 1, #cases do
  local name, flow, density, speed = table.unpack(cases[i])
  runs[name], quick[name] = { scene = "../corridor-" .. name .. ".yaml", seeds = "101-110" }, { seeds = 3 }
  pictures[name] = { "paths.png", "middle.png" }
  expect[#expect + 1] = measure.expected("flow " .. name, "1/s", "people through per second, both ways, " .. name,
    flow, 0.15)
  expect[#expect + 1] = measure.expected("density " .. name, "1/m2", "density in the middle, " .. name, density, 0.25)
  expect[#expect + 1] = measure.expected("speed " .. name, "m/s", "speed there, " .. name, speed, 0.25)
end

return claim {
  id = "L2", title = "Two dense streams through a corridor",
  source = "Zhang et al. 2012, doi 10.1088/1742-5468/2012/02/P02002 (widths of corridor and entrances in cm), measured with the "
    .. "scenes' own probes: the flow is the sum of that of either way over its middle 60 %",
  text = "People come in at both ends of a corridor 3.6 m wide, where and when the camera saw them first. At two people per "
    .. "square metre and more the streams still pass each other.",
  level = "calm", calibrated = measure.walking_law,
  runs = runs, quick = quick,
  null = measure.by_orca("southward", "northward"),
  measure = function(run)
    local out = {}
    for name in pairs(runs) do
      local probes = run[name].summary.probes
      out["flow " .. name] = probes.southward.flow + probes.northward.flow
      out["density " .. name], out["speed " .. name] = probes.middle.density, probes.middle.speed
    end
    return out
  end,
  expect = expect,
  tried = { "The streams pass each other, but slower than recorded ones, and fill the corridor to three or four people per "
    .. "square metre: calm people keep a greater time gap to those ahead. Shoulders turned at any density (turned = 0) pass as "
    .. "many here, but lanes in a thinner crowd (L1) lose order." },
  pictures = pictures,
}
