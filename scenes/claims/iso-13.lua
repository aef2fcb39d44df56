local measure = require "measure"

local PEOPLE = { 60, 120, 240, 360, 480 }

local runs, quick, expect, speeds, flows = {}, {}, {}, {}, {}
for i = 1, #PEOPLE do
  local name = "of_" .. PEOPLE[i]
  runs[name] = { scene = "../iso-13.yaml", seeds = "101-105", set = { ["groups.people.count"] = PEOPLE[i] } }
  quick[name] = { seeds = 1 }
  expect[2 * i - 1] = { "speed_" .. PEOPLE[i], unit = "m/s", source = "none", reported = true,
    what = string.format("mean speed of %d people", PEOPLE[i]) }
  expect[2 * i] = { "flow_" .. PEOPLE[i], unit = "1/(m s)", source = "none", reported = true,
    what = string.format("specific flow of %d people", PEOPLE[i]) }
  speeds[i] = { PEOPLE[i] / 120, "speed_" .. PEOPLE[i] }
  flows[i] = { PEOPLE[i] / 120, "flow_" .. PEOPLE[i] }
end
expect[#expect + 1] = { "rises", what = "numbers of people with which they are not slower than with the one before",
  source = "speed falls", band = { 0, 0 } }
expect[#expect + 1] = { "before", unit = "1/(m s)", what = "by how much the greatest flow exceeds that of the fewest",
  source = "flow rises, then falls; 0.05 ours", band = { 0.05 } }
expect[#expect + 1] = { "after", unit = "1/(m s)", what = "by how much it exceeds that of the most",
  source = "flow rises, then falls; 0.05 ours", band = { 0.05 } }

return claim {
  id = "O13", title = "ISO 13: speed falls with density, and the flow has a greatest value between",
  source = "ISO 20414:2020, test 13, by notes of an open implementation",
  text = "A corridor of 2 x 60 m is filled with 60 to 480 people who all walk one way. In its middle third people are the "
    .. "slower the more there are, and the flow is greatest at a density between the least and the most.",
  level = "normal", held_out = measure.walking_law,
  runs = runs, quick = quick,
  null = { text = "the same number of people in all runs", set = { ["groups.people.count"] = 240 } },
  measure = function(run)
    local out, v, j = {}, {}, {}
    for i = 1, #PEOPLE do
      local zone = run["of_" .. PEOPLE[i]].summary.probes.zone
      v[i], j[i] = zone.speed, zone.specific_flow
      out["speed_" .. PEOPLE[i]], out["flow_" .. PEOPLE[i]] = v[i], j[i]
    end
    out.rises = measure.rises(v)
    out.before, out.after = measure.most(j) - j[1], measure.most(j) - j[#j]
    return out
  end,
  expect = expect,
  plots = {
    { name = "speed", title = "ISO 13: speed", x = "people placed per m²", y = "mean speed (m/s)", { "Jostle", figures = speeds } },
    { name = "flow", title = "ISO 13: flow", x = "people placed per m²", y = "specific flow (1/(m s))", { "Jostle", figures = flows } },
  },
  pictures = { of_240 = { "density.png" } },
}
