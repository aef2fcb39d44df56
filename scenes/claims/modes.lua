local measure = require "measure"

-- One seed of a scene, by the equations as printed (`printed`) or as the engine reads them. Runs of the second kind, and
-- some of the first, are those of the claim on the figure.
local function run(scene, printed, set, dt, first)
  local all = {}
  for path, value in pairs(set or {}) do all[path] = value end
  if printed then all["forces.mode"] = "literal" end
  return { scene = "../" .. scene .. ".yaml", seeds = 1, dt = dt, set = next(all) and all, first = first }
end

local BLOCK = { ["groups.standing.spacing"] = 0.55, ["groups.standing.in"] = "block", ["forces.enabled"] = true }

local runs = {}
for _, mode in ipairs { "default", "printed" } do
  local printed = mode == "printed"
  runs["breaking_" .. mode] = run("wall-breaking", printed, nil, nil, true)
  runs["tight_" .. mode] = run("wall-tight", printed, nil, nil, true)
  runs["heavy_" .. mode] = run("wall-heavy", printed, nil, nil, true)
  runs["runner_" .. mode] = run("running-through", printed, BLOCK)
  runs["doors_" .. mode] = run("two-bottlenecks", printed, not printed and { ["groups.people.set.push"] = 50 }, 0.05)
  runs["office_" .. mode] = run("office", printed)
  local set = printed and { ["forces.mode"] = "literal" } or nil
  runs["tawaf_" .. mode] = measure.tawaf_run { set = set }
  runs["pushing_" .. mode] = measure.tawaf_run { scene = "../tawaf-pushing.yaml", set = set }
  runs["stability_" .. mode] = { scene = "../stability.yaml", dt = 0.05, seeds = 1,
    set = { ["forces.mode"] = printed and "literal" or "physical" } }
end

-- Figures of a mode: name of the run, name and unit of the figure, what it is, and how it is read.
local FIGURES = {
  { "breaking", "pieces", "", "Fig. 2, a wall that breaks: pieces in the end",
    function(r) return r.summary.bonds.pieces end },
  { "breaking", "broken_out", "", "people of 1200 who got through", function(r) return 1200 - r.summary.agents end },
  { "runner", "moved", "m", "Fig. 5, running through: greatest displacement, mean of the 25",
    function(r) return r.summary.probes.standing.peak_mean end },
  { "doors", "through", "", "Fig. 6, two bottlenecks: people through both in 180 s",
    function(r) return r.summary.probes.second.passages end },
  { "doors", "lapse", "s", "longest time that nobody came through",
    function(r) return r.summary.probes.second.lapse_max end },
  { "tight", "tight_moved", "m", "Fig. 7a, a wall that turns: moved by", function(r) return r.summary.bonds.moved end },
  { "tight", "tight_turned", "deg", "turned by, to either side",
    function(r) return math.abs(r.summary.bonds.turned) end },
  { "tight", "tight_out", "", "people of 1200 who got out", function(r) return 1200 - r.summary.agents end },
  { "heavy", "heavy_moved", "m", "Fig. 7b, a wall that hardly moves: moved by",
    function(r) return r.summary.bonds.moved end },
  { "heavy", "heavy_density", "1/m2", "greatest density", function(r) return r.summary.density_max end },
  { "office", "office_left", "", "Fig. 8, an office: people of 1200 who got out",
    function(r) return r.summary.events.removed end },
  { "office", "office_residual", "", "momentum that people and bodies do not exchange alike, share of all",
    function(r) return r.summary.exchange.residual end },
  { "tawaf", "density", "1/m2", "Fig. 12, the Tawaf: greatest density",
    function(r) return r.summary.probes.fields.density_max end },
  { "tawaf", "touched", "", "Fig. 13, people who touched the Black Stone in 600 s",
    function(r) return r.summary.probes.stone.passages end },
  { "tawaf", "R1", "m/s", "Fig. 14, mean speed in R1", function(r) return r.summary.regions.R1 end },
  { "tawaf", "R6", "m/s", "mean speed in R6", function(r) return r.summary.regions.R6 end },
  { "stability", "failures", "", "Fig. 16, programs without a solution in the worst second, share",
    function(r) return r.summary.probes.solved.peak end },
}

local function mean_speed(regions)
  local sum = 0
  for i = 1, 7 do sum = sum + regions["R" .. i] / 7 end
  return sum
end

local expect = {}
for _, figure in ipairs(FIGURES) do
  local _, name, unit, what = table.unpack(figure)
  for _, mode in ipairs { "default", "printed" } do
    expect[#expect + 1] = { name .. "_" .. mode, unit = unit ~= "" and unit or nil, reported = true,
      what = mode == "default" and what .. ", default mode" or "the same, as printed" }
  end
end
expect[#expect + 1] = { "gain_default", reported = true,
  what = "Fig. 15, gain in the mean speed of the regions by harder pushing, default mode" }
expect[#expect + 1] = { "gain_printed", reported = true, what = "the same, as printed" }

return claim {
  id = "2-16", title = "The paper's scenes by its equations as printed, and by the engine's reading of them",
  source = "Kim et al. 2014, equations 1 to 12 and Figs. 2, 5 to 8 and 12 to 16",
  text = "Each scene once, with the default mode beside the equations as printed. No source says what these give, so "
    .. "all is reported. Printed, the runner moves those who stand (Fig. 5), nearly all programs have a solution "
    .. "(Fig. 16), people and bodies exchange momentum alike (Fig. 8), the Tawaf is as dense (Fig. 12), and R1 is slower "
    .. "than R6 (Fig. 14). But no wall breaks or turns (Figs. 2 and 7a), as people avoid the bounding spheres of its "
    .. "blocks and hardly reach them; pushing does not resolve the jams (Fig. 6), and few get to the Black Stone "
    .. "(Fig. 13). Harder pushing in the Tawaf brings no gain in either mode (Fig. 15).",
  level = "keen",
  calibrated = "all behaviours of these scenes were chosen in the default mode, as the other claims on them say",
  runs = runs, quick = false,
  no_null = "all figures are reported, and none has a band that a null could miss",
  measure = function(run)
    local out = {}
    for _, mode in ipairs { "default", "printed" } do
      for _, figure in ipairs(FIGURES) do
        local from, name, _, _, read = table.unpack(figure)
        out[name .. "_" .. mode] = read(run[from .. "_" .. mode])
      end
      out["gain_" .. mode] = mean_speed(run["pushing_" .. mode].summary.regions)
        / mean_speed(run["tawaf_" .. mode].summary.regions) - 1
    end
    return out
  end,
  expect = expect,
}
