local function run(dt) return { scene = "../stability.yaml", dt = dt, seeds = 8 } end

return claim {
  id = "11", title = "Nearly everybody finds a velocity that meets all constraints",
  source = "Kim et al. 2014, Fig. 16",
  text = "One runs through fifty people who stand 0.6 m apart. Share of agent-steps whose linear program has no "
    .. "solution, in the worst second. Steps longer than 0.05 s are cut; a person counts once a step.",
  level = "normal",
  calibrated = "how often people plan and how fast they follow, 0.05 s both, were chosen on it and on claim 12; the "
    .. "runner's push on claim 1",
  runs = { dt010 = run(0.01), dt020 = run(0.02), dt050 = run(0.05), dt100 = run(0.1), dt200 = run(0.2) },
  null = { text = "the equations as printed, which act within a step of whatever length", set = { ["forces.mode"] = "literal" } },
  measure = function(run)
    local function peak(name) return run[name].summary.probes.solved.peak end
    return { peak_01 = peak("dt010"), peak_02 = peak("dt020"), peak_05 = peak("dt050"), peak_10 = peak("dt100"),
      peak_20 = peak("dt200") }
  end,
  expect = {
    { "peak_01", what = "failures in the worst second, dt 0.01 s", source = "0.05", band = { 0, 0.06 } },
    { "peak_02", what = "the same, dt 0.02 s", source = "0.05", band = { 0, 0.06 } },
    { "peak_05", what = "the same, dt 0.05 s", source = "0.05", band = { 0, 0.06 } },
    { "peak_10", what = "the same, dt 0.1 s", source = "0.05", band = { 0, 0.06 } },
    { "peak_20", what = "the same, dt 0.2 s", source = "0.05", band = { 0, 0.08 } },
  },
  pictures = { dt050 = { "solved.png" } },
}
