local measure = require "measure"

-- Motivation, its name in figures, and the source's flow, 1/s, density, 1/m2, and speed, m/s, before the door.
local cases = {
  { "keen", "high motivation", 1.24, 5.6, 0.23 },
  { "calm", "low motivation", 1.00, 2.3, 0.39 },
}

local runs, quick, expect = {}, {}, {}
for i = 1, #cases do
  local haste, who, flow, density, speed = table.unpack(cases[i])
  runs[haste] = { scene = "../door-050-corridor.yaml", seeds = "101-110", set = { ["groups.people.set.haste"] = haste } }
  quick[haste] = { seeds = 3 }
  expect[#expect + 1] = measure.expected("flow " .. haste, "1/s", "people through per second, the middle 60 %, " .. who,
    flow, 0.15)
  expect[#expect + 1] = measure.expected("density " .. haste, "1/m2", "density in the square metre before the door, " .. who,
    density, 0.25)
  expect[#expect + 1] = measure.expected("speed " .. haste, "m/s", "speed there, " .. who, speed, 0.25)
end

return claim {
  id = "B5", title = "A door of half a metre at the end of a corridor",
  source = "63 people, Wuppertal 2018, experiments 110 and 120, doi 10.34735/ped.2018.1; Adrian, Seyfried, Sieben 2020, doi "
    .. "10.1098/rsif.2019.0871; measured with the scene's own probes",
  text = "The door of B1 at the end of a corridor 1.2 m wide. People who are told that only the first will see the stage well "
    .. "pass a quarter faster than people who are told that all will see it, and stand twice as close; we take them to be "
    .. "keen, the others calm.",
  level = "keen", held_out = measure.walking_law,
  runs = runs, quick = quick,
  null = measure.by_orca("people"),
  measure = function(run)
    local out = {}
    for haste in pairs(runs) do
      local probes = run[haste].summary.probes
      out["flow " .. haste] = probes.door.flow
      out["density " .. haste], out["speed " .. haste] = probes.front.density, probes.front.speed
    end
    return out
  end,
  expect = expect,
  tried = { "Calm people stand at 3.4 per square metre if they do not compete with those beside them (walking.rivals = 16), and at "
    .. "4.1 as they do: their ways converge over the last metre before the door. Normal ones stand at 5.4 without rivals." },
  pictures = { keen = { "door.png", "front.png" }, calm = { "door.png", "front.png" } },
}
