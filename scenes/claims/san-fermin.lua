local measure = require "measure"

local STAGES = 6
local RISES = 2 -- least ratio of the peak power of directions to that of slower turns

-- A run of people who press on with this speed, m/s; 0: nobody does.
local function run(drive)
  return { scene = "../san-fermin.yaml", seeds = 1,
    set = { ["groups.crowd.memory.drive"] = drive, ["groups.crowd.memory.carry"] = 1 } }
end

local expect, spectra = {}, { as_is = {}, pressed = {} }
for _, run in ipairs { "as_is", "pressed" } do
  local whose = run == "as_is" and "" or ", of people who press"
  expect[#expect + 1] = { run .. "_onset", unit = "1/m2", source = "4.0 +- 0.5", band = { 3.5, 4.5 },
    what = "least density at which directions turn with one frequency (0: at none)" .. whose }
  expect[#expect + 1] = { run .. "_frequency", unit = "rad/s", source = "0.35 +- 0.05", band = { 0.3, 0.4 },
    what = "that frequency, at the greatest density that has one (0: none)" .. whose }
  expect[#expect + 1] = { run .. "_anticlockwise", reported = true, source = "either way",
    what = "share of windows that turn anti-clockwise" .. whose }
  expect[#expect + 1] = { run .. "_speed", unit = "m/s", reported = true, source = "none",
    what = "speed of windows at the greatest density" .. whose }
  for stage = 1, STAGES do
    local density, rises = run .. "_density_" .. stage, run .. "_rises_" .. stage
    expect[#expect + 1] = { density, unit = "1/m2", reported = true, source = "none",
      what = "density, stage " .. stage .. whose }
    expect[#expect + 1] = { rises, reported = true, source = "ours: counts from 2 on",
      what = "greatest power over that of slower turns, stage " .. stage .. whose }
    spectra[run][stage] = { stage, rises }
  end
end

return claim {
  id = "G", title = "A dense crowd turns round as one",
  source = "San Fermin, Gu et al. 2025, doi 10.1038/s41586-024-08514-6",
  text = "A square of 50 x 20 m fills from two to six people per square metre. Filmed crowds above four per square "
    .. "metre turn round, either way, with the frequency of 0.35 rad/s: seen in the directions of the mean velocities "
    .. "of windows of 1.5 m, not in their speeds. Looked at are people who come, and stand where they get to, and "
    .. "people who press on with 0.4 m/s in a way that turns to where the crowd carries them. Those who press let hardly "
    .. "anybody in, and stay below 2.5 per square metre: their run says nothing of denser crowds.",
  level = "normal", held_out = measure.walking_law .. " The drive and how soon it turns were looked at on seed 201.",
  runs = { as_is = run(0), pressed = run(0.4) },
  null = { text = "nobody presses on: the run of people who stand, once more", runs = { pressed = run(0) } },
  quick = false,
  measure = function(run)
    local out = {}
    for name, of in pairs(run) do
      out[name .. "_onset"], out[name .. "_frequency"] = 0, 0
      for stage = STAGES, 1, -1 do
        local swirl = of.summary.probes["swirl_" .. stage]
        out[name .. "_density_" .. stage], out[name .. "_rises_" .. stage] = swirl.density, swirl.rises
        if swirl.rises >= RISES then
          out[name .. "_onset"] = swirl.density
          if out[name .. "_frequency"] == 0 then out[name .. "_frequency"] = swirl.frequency end
        end
      end
      local last = of.summary.probes["swirl_" .. STAGES]
      out[name .. "_anticlockwise"], out[name .. "_speed"] = last.anticlockwise, last.speed
    end
    return out
  end,
  expect = expect,
  plots = { { name = "rises", title = "San Fermin: how far one frequency stands out",
    x = "stage (2.5 to 6.3 people per m²)", y = "greatest power over that of slower turns",
    { "who stands", figures = spectra.as_is }, { "who presses", figures = spectra.pressed } } },
  tried = {
    "Boxes of 25 x 20 m, 4 to 6.5 people per square metre, all pressing from the beginning: drives of 0.4 and 0.8 m/s, "
      .. "ways that turn by a radian in 0.3, 1 and 10 m. Directions change slowly, and no frequency stands out.",
    "At 6 per square metre with 0.8 m/s and 0.3 m, 77 % of the windows turn the same way: the crowd goes round the "
      .. "box, but slower than its spectrum of 120 s tells from rest.",
    "Without a drive, who stands is moved by those who come alone, and not at all once nobody comes.",
  },
  pictures = { as_is = { "swirl_5.png", "density.png" }, pressed = { "swirl_5.png" } },
}
