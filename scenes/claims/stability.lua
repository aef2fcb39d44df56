-- Difference of a run's figure from that with the finest step.
local function against(run, what, of)
  local finest = what(run.dt010)
  return what(of) / finest - 1
end
local function moved(run) return run.summary.probes.standing.mean end
local function transit(run) return run.summary.probes.passage.mean end

local function run(dt) return { scene = "../stability.yaml", dt = dt, seeds = 8 } end

return claim {
  id = "12", title = "What happens hardly depends on the time step",
  source = "Kim et al. 2014, Fig. 16",
  text = "One runs through fifty people who stand 0.6 m apart, at five time steps: residual displacement and "
    .. "transit time, compared with those at dt = 0.01 s. Steps longer than 0.05 s are cut into substeps of 0.05 s at "
    .. "most, so 0.1 and 0.2 s say what 0.05 s says, but for how often machines think.",
  level = "normal",
  calibrated = "how often people plan and how fast they follow, 0.05 s both, were chosen on it and on claim 11; the "
    .. "runner's push on claim 1",
  runs = { dt010 = run(0.01), dt020 = run(0.02), dt050 = run(0.05), dt100 = run(0.1), dt200 = run(0.2) },
  null = { text = "the equations as printed, which act within a step of whatever length", set = { ["forces.mode"] = "literal" } },
  measure = function(run)
    return {
      moved_02 = against(run, moved, run.dt020), moved_05 = against(run, moved, run.dt050),
      moved_10 = against(run, moved, run.dt100), moved_20 = against(run, moved, run.dt200),
      transit_02 = against(run, transit, run.dt020), transit_05 = against(run, transit, run.dt050),
      transit_10 = against(run, transit, run.dt100), transit_20 = against(run, transit, run.dt200),
    }
  end,
  expect = {
    { "moved_02", what = "residual displacement, dt 0.02 s against 0.01 s", source = "small", band = { -0.2, 0.2 } },
    { "moved_05", what = "the same, dt 0.05 s", source = "small", band = { -0.2, 0.2 } },
    { "moved_10", what = "the same, dt 0.1 s", source = "small", band = { -0.2, 0.2 } },
    { "moved_20", what = "the same, dt 0.2 s", source = "small", band = { -0.2, 0.2 } },
    { "transit_02", what = "transit time, dt 0.02 s against 0.01 s", source = "small", band = { -0.1, 0.1 } },
    { "transit_05", what = "the same, dt 0.05 s", source = "small", band = { -0.1, 0.1 } },
    { "transit_10", what = "the same, dt 0.1 s", source = "small", band = { -0.1, 0.1 } },
    { "transit_20", what = "the same, dt 0.2 s", source = "small", reported = true },
  },
  plots = { { name = "steps", title = "Against the step of 0.01 s", x = "time step (s)", y = "relative difference",
    { "residual displacement", figures = { { 0.02, "moved_02" }, { 0.05, "moved_05" }, { 0.1, "moved_10" },
      { 0.2, "moved_20" } } },
    { "transit time", figures = { { 0.02, "transit_02" }, { 0.05, "transit_05" }, { 0.1, "transit_10" },
      { 0.2, "transit_20" } } } } },
  pictures = { dt050 = { "paths.png", "standing.png" } },
}
