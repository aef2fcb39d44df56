local measure = require "measure"

local GROUPS = { "adults", "age_20", "age_30", "age_40", "age_50", "age_60", "age_70", "age_80" }
local LENGTH = 40 -- m, between the lines of the probes

-- Speeds of those who crossed both lines, m/s.
local function speeds(passages)
  local list = {}
  for i = 1, passages.n do list[i] = LENGTH / passages.transit[i] end
  return list
end

return claim {
  id = "R7", title = "RiMEA 7: speeds of people by age",
  source = "RiMEA guideline, test 7; Weidmann 1993; Bohannon and Andrews 2011, doi 10.1016/j.physio.2010.12.004",
  text = "Fifty adults walk as fast as Weidmann's normal distribution says, fifty of each decade as fast as their "
    .. "age. Bands: three standard errors of the mean of 150 people, 5 % for the older ones.",
  level = "normal", held_out = measure.walking_law,
  runs = { walk = { scene = "../rimea-07.yaml", seeds = "101-110" } },
  quick = { walk = { seeds = 3 } },
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
    { "people", what = "people who arrive, of 400", source = "400", band = { 400, 400 } },
    { "adults", unit = "m/s", what = "adults, mean", source = "1.34", band = { 1.275, 1.405 } },
    { "deviation", unit = "m/s", what = "adults, standard deviation", source = "0.26", band = { 0.21, 0.31 } },
    { "slow", unit = "m/s", what = "adults: slower are 16 %", source = "1.08", band = { 0.98, 1.18 } },
    { "fast", unit = "m/s", what = "adults: faster are 16 %", source = "1.60", band = { 1.5, 1.7 } },
    { "age_20", unit = "m/s", what = "20 to 29 years, mean", source = "1.35", band = { 1.285, 1.415 } },
    { "age_30", unit = "m/s", what = "30 to 39 years", source = "1.39", band = { 1.32, 1.45 } },
    { "age_40", unit = "m/s", what = "40 to 49 years", source = "1.41", band = { 1.345, 1.48 } },
    { "age_50", unit = "m/s", what = "50 to 59 years", source = "1.37", band = { 1.305, 1.44 } },
    { "age_60", unit = "m/s", what = "60 to 69 years", source = "1.29", band = { 1.225, 1.355 } },
    { "age_70", unit = "m/s", what = "70 to 79 years", source = "1.20", band = { 1.14, 1.26 } },
    { "age_80", unit = "m/s", what = "80 years and more", source = "0.96", band = { 0.91, 1.005 } },
  },
  pictures = { walk = { "adults.png" } },
}
