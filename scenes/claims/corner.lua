local measure = require "measure"

-- Probe, what it measures, the source's density there, 1/m2, and speed, m/s.
local areas = {
  { "before", "before the bend, 1 to 3 m from it", 0.99, 1.10 },
  { "corner", "in the bend", 0.58, 1.12 },
  { "after", "behind it, 2 m", 0.97, 1.13 },
}

local expect = {
  measure.expected("flow", "1/s", "people round the bend per second, the middle 60 %", 3.18, 0.15),
}
for i = 1, #areas do
  local probe, where, density, speed = table.unpack(areas[i])
  expect[#expect + 1] = measure.expected("density " .. probe, "1/m2", "density " .. where, density, 0.25)
  expect[#expect + 1] = measure.expected("speed " .. probe, "m/s", "speed there", speed, 0.25)
end

return claim {
  id = "C1", title = "Round the corner of a corridor",
  source = "137 people, corner_300, archive of Juelich, measured with the scene's own probes",
  text = "A corridor 3 m wide turns by a right angle. People come in where and when the camera saw them first; they use "
    .. "the width of the bend and hardly slow down.",
  level = "calm", calibrated = measure.walking_law,
  runs = { corner = { scene = "../corner-300.yaml", seeds = "101-110" } },
  quick = { corner = { seeds = 3 } },
  null = measure.shortest_way(),
  measure = function(run)
    local probes = run.corner.summary.probes
    local out = { flow = probes.line.flow }
    for i = 1, #areas do
      local probe = areas[i][1]
      out["density " .. probe], out["speed " .. probe] = probes[probe].density, probes[probe].speed
    end
    return out
  end,
  expect = expect,
  pictures = { corner = { "line.png", "paths.png" } },
}
