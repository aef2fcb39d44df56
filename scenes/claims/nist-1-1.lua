local measure = require "measure"

local function of(distribution, duration)
  return { scene = "../premovement-many.yaml", seeds = "101-103", duration = duration, dt = 0.1,
    set = { ["groups.people.set.premovement"] = distribution } }
end

local function wait(distribution) return { set = { ["groups.people.set.premovement"] = distribution } } end

return claim {
  id = "N1.1", title = "NIST 1.1: time before people move",
  source = "NIST TN 1822, test 1.1, as implemented by the verification notebooks of JuPedSim",
  text = "Four hundred people in a room wait for times of four distributions, one after the other. What comes out is of the "
    .. "distribution that was asked for.",
  level = "calm", held_out = measure.walking_law,
  runs = measure.calm({ uniform = of("uniform(10, 100)", 120), gamma = of("gamma(1.291, 103.901)", 1500),
    lognormal = of("lognormal(4.586, 0.967)", 3000), weibull = of("weibull(1.195, 139.285)", 1500) }, "people"),
  quick = { uniform = { seeds = 1 }, gamma = { seeds = 1 }, lognormal = { seeds = 1 }, weibull = { seeds = 1 } },
  null = { text = "times that are a fifth longer", runs = {
    uniform = wait("uniform(12, 120)"), gamma = wait("gamma(1.291, 124.681)"), lognormal = wait("lognormal(4.768, 0.967)"),
    weibull = wait("weibull(1.195, 167.142)") } },
  measure = function(run)
    local function chance(name, share) return measure.kolmogorov_smirnov(run[name].csv("waiting").transit, share) end
    return { uniform = chance("uniform", measure.uniform_share(10, 100)), gamma = chance("gamma", measure.gamma_share(1.291, 103.901)),
      lognormal = chance("lognormal", measure.lognormal_share(4.586, 0.967)), weibull = chance("weibull", measure.weibull_share(1.195, 139.285)) }
  end,
  expect = {
    { "uniform", what = "chance of so great a difference (Kolmogorov and Smirnov), even", source = "above 0.05",
      band = { 0.05, 1 } },
    { "gamma", what = "the same, gamma", source = "above 0.05", band = { 0.05, 1 } },
    { "lognormal", what = "the same, lognormal", source = "above 0.05", band = { 0.05, 1 } },
    { "weibull", what = "the same, Weibull", source = "above 0.05", band = { 0.05, 1 } },
  },
  pictures = { lognormal = { "waiting.png" } },
}
