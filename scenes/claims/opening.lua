local measure = require "measure"
local about = measure.about

return claim {
  id = "B3", title = "An opening of three metres",
  source = "348 people, AO_300, HERMES 2009, archive of Juelich, measured with the scene's own probes",
  text = "People come through an opening 3 m wide, each from where and when the camera saw them first. They were told to leave "
    .. "on a command, as the people of the corridors (F3), and are calm as those. More come through a metre of this opening "
    .. "than of the corridors.",
  level = "calm", calibrated = measure.walking_law,
  runs = { opening = { scene = "../opening-300.yaml", seeds = "101-110" } },
  quick = { opening = { seeds = 3 } },
  null = measure.by_orca("people"),
  measure = function(run)
    local probes = run.opening.summary.probes
    return {
      flow = probes.line.flow, density = probes.opening.density, speed = probes.opening.speed,
      before = probes.front.density, pace = probes.front.speed,
      median = probes.line.lapse_median, lapse = probes.line.lapse_max,
    }
  end,
  expect = {
    { "flow", unit = "1/s", what = "people through per second, the middle 60 %", source = "7.18", band = about(7.18, 0.15) },
    { "density", unit = "1/m2", what = "density in the opening", source = "3.41", band = about(3.41, 0.25) },
    { "speed", unit = "m/s", what = "speed there", source = "0.72", band = about(0.719, 0.25) },
    { "before", unit = "1/m2", what = "density in 2 by 2 m before it", source = "5.32", band = about(5.32, 0.25) },
    { "pace", unit = "m/s", what = "speed there", source = "0.38", band = about(0.381, 0.25) },
    { "median", unit = "s", what = "median time between two", source = "0.11; ours: a quarter", band = about(0.11, 0.25) },
    { "lapse", unit = "s", what = "longest time that nobody came through", source = "1.0; ours: up to 1.6",
      band = { 0, 1.6 } },
  },
  tried = { "Constants were chosen with keen people here, who pass 8.1 per second, 3.4 per square metre in the opening and 5.4 "
    .. "before it. Calm people who do not compete with those beside them (walking.rivals = 16) pass 5.4 per second; if they grow "
    .. "as eager as keen ones with fewer rivals (rivals_more = 2) they pass 6.8, and all figures are in band, but then "
    .. "the corridors of F3 let too many in and out." },
  pictures = { opening = { "line.png", "paths.png" } },
}
