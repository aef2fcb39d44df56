return claim {
  id = "B1", title = "A door of half a metre",
  source = "75 people, Wuppertal 2018, doi 10.34735/ped.2018.1",
  text = "People who want to leave a corridor of 5.6 m through a door of 0.5 m: how many a second, how dense they "
    .. "stand before it, how long nobody comes through.",
  runs = { door = { scene = "../door-050.yaml", seeds = 8 } },
  quick = { door = { seeds = 3 } },
  measure = function(run)
    local probes = run.door.summary.probes
    return {
      flow = probes.door.flow, density = probes.front.density, lapse = probes.door.lapse_max,
      median = probes.door.lapse_median, cleared = probes.door.last, p90 = probes.front.density_p90,
    }
  end,
  expect = {
    { "flow", unit = "1/s", what = "people through per second, the middle 60 %", source = "1.15",
      band = { 0.95, 1.35 } },
    { "density", unit = "1/m2", what = "density in the metre before the door (Voronoi)", source = "6.2",
      band = { 5.5, 8 } },
    { "lapse", unit = "s", what = "longest time that nobody came through", source = "2.5", band = { 0, 4 } },
    { "median", unit = "s", what = "median time between two", source = "0.84", reported = true },
    { "cleared", unit = "s", what = "when the last came through", source = "64.5", reported = true },
    { "p90", unit = "1/m2", what = "density, 90th percentile", source = "8.6", reported = true },
  },
  pictures = { door = { "door.png", "front.png", "density.png" } },
}
