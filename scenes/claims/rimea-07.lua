local measure = require "measure"

local GROUPS = { "adults", "age_20", "age_30", "age_40", "age_50", "age_60", "age_70" }
local LENGTH = 40 -- m, between the lines of the probes

-- The speeds of the adults, for people of all ages.
local one_age = {}
for i = 2, #GROUPS do one_age["groups." .. GROUPS[i] .. ".set.speed"] = "normal(1.34, 0.26, 0.4, 2.4)" end

-- Speeds of the people who crossed both lines, m/s.
local function speeds(passages)
  local list = {}
  for i = 1, passages.n do list[i] = LENGTH / passages.transit[i] end
  return list
end

return claim {
  id = "R7", title = "RiMEA 7: speeds of people by age",
  source = "RiMEA 4.1.1, test 7, as implemented by an open social-force suite that quotes it; Weidmann 1993",
  text = "Fifty people have the speeds of their ages: ten each of 20, 30, 40 and 50 years, five each of 60 and 70. Fifty more "
    .. "have those of Weidmann's normal distribution. The curve over age and the distribution come out. Bands: three standard "
    .. "errors of what all seeds together have of an age, about the range that the test gives.",
  level = "normal", held_out = measure.walking_law,
  runs = { walk = { scene = "../rimea-07.yaml", seeds = "101-110" } },
  quick = { walk = { seeds = 3 } },
  null = { text = "people of all ages with the speeds of the adults", set = one_age },
  measure = function(run)
    local figures, all = {}, 0
    for i = 1, #GROUPS do
      local name = GROUPS[i]
      local list = speeds(run.walk.csv(name))
      figures[name] = measure.mean(list)
      all = all + #list
      if name == "adults" then
        figures.deviation = measure.deviation(list)
        figures.slow, figures.fast = measure.quantile(list, 0.16), measure.quantile(list, 0.84)
      end
    end
    figures.people = all
    return figures
  end,
  expect = {
    { "people", what = "people who arrive, of 100", source = "50 by age, ours: 50 adults", band = { 100, 100 } },
    { "adults", unit = "m/s", what = "adults, mean", source = "1.34 (Weidmann)", band = { 1.275, 1.405 } },
    { "deviation", unit = "m/s", what = "adults, standard deviation", source = "0.26 (Weidmann)", band = { 0.21, 0.31 } },
    { "slow", unit = "m/s", what = "adults: slower are 16 %", source = "1.08 (Weidmann)", band = { 0.98, 1.18 } },
    { "fast", unit = "m/s", what = "adults: faster are 16 %", source = "1.60 (Weidmann)", band = { 1.5, 1.7 } },
    { "age_20", unit = "m/s", what = "20 years, mean", source = "1.60 to 1.64; bands ours", band = { 1.5, 1.74 } },
    { "age_30", unit = "m/s", what = "30 years", source = "1.52 to 1.56", band = { 1.425, 1.655 } },
    { "age_40", unit = "m/s", what = "40 years", source = "1.46 to 1.50", band = { 1.365, 1.595 } },
    { "age_50", unit = "m/s", what = "50 years", source = "1.39 to 1.43", band = { 1.3, 1.52 } },
    { "age_60", unit = "m/s", what = "60 years", source = "1.27", band = { 1.16, 1.38 } },
    { "age_70", unit = "m/s", what = "70 years", source = "1.07", band = { 0.975, 1.165 } },
  },
  plots = { { name = "ages", title = "RiMEA 7: speed and age", x = "age (years)", y = "mean speed (m/s)",
    { "Jostle", figures = { { 20, "age_20" }, { 30, "age_30" }, { 40, "age_40" }, { 50, "age_50" }, { 60, "age_60" },
      { 70, "age_70" } } },
    { "the test", points = { { 20, 1.62 }, { 30, 1.54 }, { 40, 1.48 }, { 50, 1.41 }, { 60, 1.27 }, { 70, 1.07 } } } } },
  pictures = { walk = { "adults.png" } },
}
