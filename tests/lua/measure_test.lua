-- measure.lua: the arithmetic of claims, against figures worked out by hand.
local measure = require "measure"

test("mean, deviation, least and most", function()
  local list = { 2, 4, 4, 4, 5, 5, 7, 9 }
  equal(measure.mean(list), 5)
  near(measure.deviation(list), math.sqrt(32 / 7), 1e-12)
  equal(measure.least(list), 2)
  equal(measure.most(list), 9)
  equal(measure.mean { -3 }, -3)
end)

test("quantiles lie between ranks, whatever the order, and leave the list as it was", function()
  local list = { 4, 1, 3, 2 }
  equal(measure.median(list), 2.5)
  equal(measure.quantile(list, 0), 1)
  equal(measure.quantile(list, 1), 4)
  near(measure.quantile(list, 0.25), 1.75, 1e-12)
  equal(measure.median { 7 }, 7)
  equal(measure.median { 9, 1, 5 }, 5)
  equal(list[1], 4)
  equal(list[4], 2)
end)

test("crossings count both ways, of the probes with the prefix alone", function()
  local probes = {
    wall_a = { forward = 2, back = 1 }, wall_b = { forward = 0, back = 3 }, exit_wall_a = { forward = 9, back = 9 },
  }
  equal(measure.crossings(probes, "wall_"), 6)
  equal(measure.crossings(probes, "none"), 0)
end)

test("a slope is that of the line through points", function()
  equal(measure.slope({ 0, 1, 2 }, { 1, 3, 5 }), 2)
  equal(measure.slope({ 0, 1, 2 }, { 5, 5, 5 }), 0)
  near(measure.slope({ 0, 1, 2, 3 }, { 0, 1, 1, 2 }), 0.6, 1e-12)
  near(measure.slope({ 10, 11, 12, 13 }, { -3, -4, -4, -5 }), -0.6, 1e-12)
end)

test("a relative deviation counts both ways", function()
  equal(measure.rms({ 1, 2 }, { 1, 2 }), 0)
  near(measure.rms({ 1.1, 1.8 }, { 1, 2 }), 0.1, 1e-12)
  near(measure.rms({ 3, 4 }, { 2, 4 }), math.sqrt(0.125), 1e-12)
end)

test("what is expected lies in a band about the source's value, which is told to two places", function()
  local row = measure.expected("flow", "1/s", "people per second", 1.256, 0.25)
  equal(row[1], "flow")
  equal(row.unit, "1/s")
  equal(row.what, "people per second")
  equal(row.source, "1.26")
  near(row.band[1], 0.942, 1e-12)
  near(row.band[2], 1.57, 1e-12)
end)

test("rises: what is no less than the one before", function()
  equal(measure.rises { 5, 4, 3 }, 0)
  equal(measure.rises { 5, 5, 3 }, 1)
  equal(measure.rises { 1, 2, 3 }, 2)
  equal(measure.rises({ 1, 9, 8, 7 }, 2), 0)
  equal(measure.rises({ 1, 9, 8, 9 }, 2), 1)
end)

test("N(t) counts who passed forward until then", function()
  local flow = { n = 4, time = { 1, 2, 3, 4 }, direction = { 1, -1, 1, 1 } }
  equal(measure.passed(flow, 0.5), 0)
  equal(measure.passed(flow, 2.5), 1)
  equal(measure.passed(flow, 3), 2)
  equal(measure.passed(flow, 99), 3)
end)

test("a list without its trend keeps what sways about it", function()
  local list = {}
  for i = 1, 40 do list[i] = 3 + 0.5 * i + (i % 2 == 0 and 1 or -1) end
  local rest = measure.detrended(list)
  near(measure.mean(rest), 0, 1e-9)
  local order = {}
  for i = 1, 40 do order[i] = i end
  near(measure.slope(order, rest), 0, 1e-9)
  near(measure.deviation(rest), 1, 0.02)
end)

test("a run of the Tawaf is measured in its last half", function()
  local run = measure.tawaf_run { seeds = 2, duration = 100, set = { ["forces.enabled"] = false } }
  equal(run.seeds, 2)
  equal(run.duration, 100)
  equal(run.set["heatmap.from"], 50)
  equal(run.set["probes.fields.from"], 50)
  equal(run.set["forces.enabled"], false)
  equal(measure.tawaf_run({}).set["heatmap.from"], 300)
end)
