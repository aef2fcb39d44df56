local measure = require "measure"
local about = measure.about

return claim {
  id = "B4", title = "A door of 0.8 m, and pupils",
  source = "46 pupils, archive of Juelich, measured with the scene's own probes",
  text = "Pupils leave a room by a door of 0.8 m. More come through than grown-ups would; they are narrower, and press on.",
  level = "keen", calibrated = measure.walking_law,
  runs = { door = { scene = "../door-080.yaml", seeds = "101-110" } },
  quick = { door = { seeds = 3 } },
  null = { text = "pupils of normal haste", set = { ["groups.people.set.haste"] = "normal" }, seeds = 1 },
  measure = function(run)
    local probes = run.door.summary.probes
    return { flow = probes.line.flow, density = probes.front.density, speed = probes.front.speed,
      lapse = probes.line.lapse_max }
  end,
  expect = {
    { "flow", unit = "1/s", what = "people through per second, the middle 60 %", source = "2.97", band = about(2.97, 0.15) },
    { "density", unit = "1/m2", what = "density in the square metre before the door", source = "4.7",
      band = about(4.74, 0.25) },
    { "speed", unit = "m/s", what = "speed there", source = "0.34", band = about(0.343, 0.25) },
    { "lapse", unit = "s", what = "longest time that nobody came through", source = "1.0; ours: up to 1.6",
      band = { 0, 1.6 } },
  },
  tried = { "Keen people pass 2.3 to 2.4 per second, as dense as recorded ones and two thirds as fast: the door holds them up." },
  pictures = { door = { "line.png", "paths.png" } },
}
