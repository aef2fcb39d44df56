local measure = require "measure"

-- Flow per metre through an exit of b metres, 1/(m s), by the line of bottlenecks and by SFPE with effective width.
local function line(b) return 1.92 - 0.07 / b end
local function sfpe(b) return 1.32 * (b - 0.3) / b end

-- m; and people, as many as keep the flow up.
local exits = { { 0.8, 200 }, { 1.2, 250 }, { 1.8, 320 }, { 2.4, 400 }, { 3.6, 550 }, { 5.0, 700 } }
local bends = { 0.8, 1.2, 2.4, 4.0, 6.0 }

local function exit(b, people)
  local half = b / 2
  return { scene = "../exit.yaml", seeds = "101-110", set = {
    ["groups.people.count"] = people,
    ["walls.0.line.2.1"] = half, ["walls.0.line.3.1"] = half,
    ["walls.1.line.2.1"] = -half, ["walls.1.line.3.1"] = -half,
  } }
end

local function bend(b)
  return { scene = "../bend.yaml", seeds = "101-110", set = {
    ["groups.people.count"] = 50 * b,
    ["places.crowd.polygon.0.1"] = -b, ["places.crowd.polygon.1.1"] = -b,
    ["places.goal.polygon.0.0"] = -b, ["places.goal.polygon.3.0"] = -b,
    ["walls.1.line.1.1"] = -b, ["walls.1.line.2.0"] = -b, ["walls.1.line.2.1"] = -b, ["walls.1.line.3.0"] = -b,
    ["probes.line.flow.0.0"] = -b, ["probes.corner.during.0.0"] = -b,
    ["probes.corner.measure.0.0"] = -b, ["probes.corner.measure.0.1"] = -b,
    ["probes.corner.measure.1.1"] = -b, ["probes.corner.measure.3.0"] = -b,
  } }
end

local function exit_name(b) return string.format("exit%03.0f", 100 * b) end
local function bend_name(b) return string.format("bend%03.0f", 100 * b) end

local runs, quick, expect, through, round = {}, {}, {}, {}, {}
for i = 1, #exits do
  local b, people = table.unpack(exits[i])
  local name = exit_name(b)
  runs[name], quick[name], through[i] = exit(b, people), { seeds = 1 }, { b, name }
  expect[i] = { name, unit = "1/(m s)", what = string.format("people through an exit of %.1f m, per second and metre", b),
    source = string.format("%.2f to %.2f", sfpe(b), line(b)), band = { 1.2, 1.9 } }
end
expect[#expect + 1] = { "exits least", what = "least of these over their mean", source = "1 by 1.92 b", band = { 0.85, 1 } }
expect[#expect + 1] = { "exits most", what = "greatest of these over their mean", source = "1 by 1.92 b", band = { 1, 1.15 } }
for i = 1, #bends do
  local b = bends[i]
  local name = bend_name(b)
  runs[name], quick[name], round[i] = bend(b), { seeds = 1 }, { b, name }
  expect[#expect + 1] = { name, unit = "1/(m s)", source = "none; ours: as at exits", band = { 1.2, 1.9 },
    what = string.format("people round a bend of 90 degrees in a corridor of %.1f m, per second and metre", b) }
end
expect[#expect + 1] = { "bends least", what = "least of these over their mean", source = "ours: 1", band = { 0.85, 1 } }
expect[#expect + 1] = { "bends most", what = "greatest of these over their mean", source = "ours: 1", band = { 1, 1.15 } }

return claim {
  id = "W", title = "Flow grows with the width, at exits and round bends",
  source = "1.92 b - 0.07 (Seyfried et al. 2009), 82 people per metre and minute (Green Guide), SFPE with effective width; bends: "
    .. "3.18 1/s at 3 m (corner_300)",
  text = "What a metre of width lets through hardly depends on how many metres there are. The band of 1.2 to 1.9 is ours, "
    .. "between the three laws. ORCA fails at exits (5.6 at 5 m), not at bends.",
  level = "normal", calibrated = measure.walking_law,
  runs = runs, quick = quick, null = measure.shortest_way(),
  measure = function(run)
    local out = {}
    local function collect(list, kind)
      local flows, sum = {}, 0
      for i = 1, #list do
        local b, name = list[i][1], list[i][2]
        flows[i] = run[name].summary.probes[kind].flow / b
        out[name], sum = flows[i], sum + flows[i]
      end
      return measure.least(flows) / (sum / #list), measure.most(flows) / (sum / #list)
    end
    out["exits least"], out["exits most"] = collect(through, "exit")
    out["bends least"], out["bends most"] = collect(round, "line")
    return out
  end,
  expect = expect,
  plots = { { name = "flow", title = "Specific flow at exits and round bends", x = "width (m)", y = "flow (1/(m s))",
    { "exits", figures = through }, { "bends", figures = round } } },
  tried = { "Exits in thin walls pass 2.0 to 2.3 per metre and second: people who come from all sides compete, fan out behind "
    .. "the exit, and each soon has free space ahead. Openings as short pass as many of real crowds that are calm (F3, F3b, B3: "
    .. "1.9 to 2.4). Without rivals (walking.rivals = 16) 1.9 to 2.1 pass; a greater cost of turning (0.8 for 0.48) takes 2 to "
    .. "9 % off, and counting less on the speed of those ahead (ahead_share 0.2 for 0.54) nothing at exits wider than 0.8 m." },
  pictures = { exit240 = { "exit.png", "paths.png" }, bend400 = { "paths.png" } },
}
