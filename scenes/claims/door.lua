local measure = require "measure"
local about = measure.about

return claim {
  id = "B1", title = "A door of half a metre",
  source = "75 people, Wuppertal 2018, experiment 040, doi 10.34735/ped.2018.1, measured with the scene's own probes",
  text = "People who want to leave a corridor of 5.6 m through an opening that narrows from 0.8 m to 0.5 m, standing at the "
    .. "beginning where they stood: how many a second, how dense they are before it, how long nobody comes through.",
  level = "normal", calibrated = measure.walking_law,
  runs = { door = { scene = "../door-050.yaml", seeds = "101-110" } },
  quick = { door = { seeds = 3 } },
  null = measure.by_orca("people"),
  measure = function(run)
    local probes = run.door.summary.probes
    return {
      flow = probes.door.flow, density = probes.front.density, speed = probes.front.speed,
      square = probes.square.density, tenth = probes.square.density_p90,
      lapse = probes.door.lapse_max, median = probes.door.lapse_median, cleared = probes.door.last,
    }
  end,
  expect = {
    { "flow", unit = "1/s", what = "people through per second, the middle 60 %", source = "1.15", band = about(1.15, 0.15) },
    { "density", unit = "1/m2", what = "density in the square metre before the door", source = "6.8",
      band = about(6.76, 0.25) },
    { "square", unit = "1/m2", what = "density in 0.8 by 0.8 m, 0.5 m before the door, all the time", source = "6.2",
      band = about(6.2, 0.25) },
    { "tenth", unit = "1/m2", what = "density there that a tenth of the time exceeds", source = "8.6",
      band = about(8.6, 0.25) },
    { "lapse", unit = "s", what = "longest time that nobody came through", source = "2.5; ours: up to 4", band = { 0, 4 } },
    { "speed", unit = "m/s", what = "speed there, sway of the head included in the source", source = "0.13", reported = true },
    { "median", unit = "s", what = "median time between two", source = "0.84; ours: a quarter",
      band = about(0.84, 0.25) },
    { "cleared", unit = "s", what = "when the last came through", source = "65.0; ours: as the flow",
      band = about(65, 0.15) },
  },
  pictures = { door = { "door.png", "front.png", "density.png" } },
}
