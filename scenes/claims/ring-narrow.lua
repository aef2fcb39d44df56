local measure = require "measure"

-- Archive's name of the ring, its width, m, and length, m, unrolled; density in its straight part, 1/m2; and the speed there,
-- its deviation, m/s, and the share of people and time slower than 0.05 m/s.
local rings = {
  { "ug-100-075", 1.0, 23.83, 2.77, 0.268, 0.11, 0.03 },
  { "ug-140-085", 1.4, 24.89, 2.21, 0.331, 0.30, 0.30 },
}

-- The scene with a ring of other width and length.
local function run(width, length, density)
  return { scene = "../ring.yaml", seeds = "101-110", duration = 100, set = {
    ["groups.people.count"] = math.floor(density * length * width + 0.5),
    ["bounds.1.0"] = length, ["places.way.line.0.1"] = width / 2, ["places.way.line.1.1"] = width / 2,
    ["places.way.line.1.0"] = length, ["places.ring.polygon.1.0"] = length, ["places.ring.polygon.2.0"] = length,
    ["places.ring.polygon.2.1"] = width, ["places.ring.polygon.3.1"] = width,
    ["walls.0.line.1.0"] = length + 1, ["walls.1.line.1.0"] = length + 1,
    ["walls.1.line.0.1"] = width, ["walls.1.line.1.1"] = width,
    ["probes.middle.measure.2.1"] = width, ["probes.middle.measure.3.1"] = width, ["probes.middle.from"] = 30,
  } }
end

local runs, quick, expect = {}, {}, {}
for i = 1, #rings do
  local name, width, length, density, speed, deviation, standing = table.unpack(rings[i])
  runs[name], quick[name] = run(width, length, density), { seeds = 3 }
  expect[#expect + 1] = measure.expected("speed " .. name, "m/s", "mean speed in the ring " .. name, speed, 0.25)
  expect[#expect + 1] = { "deviation " .. name, unit = "m/s", source = string.format("%.2f", deviation),
    band = { deviation / 2, 2 * deviation }, what = "deviation of people's speeds there, within a factor of two" }
  expect[#expect + 1] = { "standing " .. name, source = string.format("%.2f", standing), band = { standing / 2, 2 * standing },
    what = "share of people and time slower than 0.05 m/s there, within a factor of two" }
end

return claim {
  id = "F6", title = "Dense rings of a metre's width, one way",
  source = "Juelich archive, rings with straights of 4 m and half circles of inner radius 2 m, unidirectional: ug-100-075 and "
    .. "ug-140-085 (width in cm, people), in the straight",
  text = "People shuffle round a narrow ring at two to three per square metre, and in the wider one stop and go. The ring is "
    .. "unrolled here, with the density of the straight part.",
  level = "calm", held_out = measure.walking_law,
  runs = runs, quick = quick, null = measure.half_gap(),
  measure = function(run)
    local out = {}
    for name in pairs(runs) do
      local middle = run[name].summary.probes.middle
      out["speed " .. name], out["deviation " .. name] = middle.speed, middle.speed_deviation
      out["standing " .. name] = middle.standing
    end
    return out
  end,
  expect = expect,
  tried = { "At equal density people walk faster here than in the wide ring of F2, recorded ones slower; and nobody stops, while "
    .. "in file (F1) people do." },
  pictures = { ["ug-100-075"] = { "middle.png" }, ["ug-140-085"] = { "middle.png" } },
}
