local steps = { 0.01, 0.02, 0.05, 0.1, 0.2 } -- s

local function run(dt, mode)
  return { scene = "../stability.yaml", dt = dt, seeds = 8, set = { ["forces.mode"] = mode } }
end

local runs, printed = {}, {}
for i = 1, #steps do
  local name = string.format("_%03.0f", 1000 * steps[i])
  if steps[i] <= 0.05 then runs["peak" .. name] = run(steps[i], "physical") end
  runs["literal" .. name] = run(steps[i], "literal")
  printed[i] = { steps[i], "literal" .. name }
end

return claim {
  id = "11", title = "Nearly everybody finds a velocity that meets all constraints",
  source = "Kim et al. 2014, Fig. 16",
  text = "One runs through fifty people who stand 0.6 m apart. Share of agent-steps whose linear program has no "
    .. "solution, in the worst second. Steps longer than 0.05 s are cut into steps of 0.05 s, so 0.1 and 0.2 s are "
    .. "the same run and are not counted. The equations as printed act within a step of whatever length: their shares "
    .. "stand beside it. The scene is loose: in dense crowds most programs fail, as the table of runs shows.",
  level = "normal",
  calibrated = "how often people plan and how fast they follow, 0.05 s both, were chosen on it and on claim 12; the "
    .. "runner's push on claim 1",
  runs = runs,
  null = { text = "people of 0.29 m radius, who leave no room between them", seeds = 1,
    set = { ["groups.standing.set.radius"] = 0.29 } },
  measure = function(run)
    local out = {}
    for name, of in pairs(run) do out[name] = of.summary.probes.solved.peak end
    return out
  end,
  expect = {
    { "peak_010", what = "failures in the worst second, dt 0.01 s", source = "0.05; band ours", band = { 0, 0.06 } },
    { "peak_020", what = "the same, dt 0.02 s", source = "0.05; band ours", band = { 0, 0.06 } },
    { "peak_050", what = "the same, dt 0.05 s", source = "0.05; band ours", band = { 0, 0.06 } },
    { "literal_010", what = "by the equations as printed, dt 0.01 s", source = "0.05", reported = true },
    { "literal_020", what = "the same, dt 0.02 s", source = "0.05", reported = true },
    { "literal_050", what = "the same, dt 0.05 s", source = "0.05", reported = true },
    { "literal_100", what = "the same, dt 0.1 s", source = "0.05", reported = true },
    { "literal_200", what = "the same, dt 0.2 s", source = "0.05", reported = true },
  },
  plots = { { name = "failures", title = "Share of programs without a solution, in the worst second",
    x = "time step (s)", y = "share",
    { "physical", figures = { { 0.01, "peak_010" }, { 0.02, "peak_020" }, { 0.05, "peak_050" } } },
    { "as printed", figures = printed } } },
  pictures = { peak_050 = { "solved.png" } },
}
