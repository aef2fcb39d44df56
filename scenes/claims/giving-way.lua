local measure = require "measure"

local WIDTH = 0.4 -- m: two radii

-- Share of the necessary distance by which each agent of a group steps aside: the opponent stands or comes offset by
-- 0.02 m, 0.04 m, ..., and two radii must be between them.
local function shares(group)
  local list = {}
  for i = 1, group.n do
    list[i] = group.peak[i] / (WIDTH - 0.02 * i)
  end
  return list
end

return claim {
  id = "14", title = "People give way to objects wholly, to each other by half",
  source = "Kim et al. 2014, equations 3 and 4",
  text = "Twelve people walk towards objects that stand in their way, twelve towards others who come from ahead. "
    .. "How far each steps aside, as a share of how far one of the two must.",
  level = "normal",
  held_out = "no constant was chosen on what this measures",
  runs = {
    way = { scene = "../giving-way.yaml", seeds = 1 }, fine = { scene = "../giving-way.yaml", dt = 0.01, seeds = 1 },
  },
  null = { text = "of two who meet, one yields 0.8 and the other 0.2", set = { ["groups.there.set.yield"] = 0.8,
    ["groups.back.set.yield"] = 0.2 } },
  measure = function(run)
    local alone, there, back = shares(run.way.csv("alone")), shares(run.way.csv("there")), shares(run.way.csv("back"))
    return {
      object = measure.mean(alone), object_least = measure.least(alone), object_most = measure.most(alone),
      agent = measure.mean(there), agent_least = measure.least(there), agent_most = measure.most(there),
      other = measure.mean(back),
      object_fine = measure.mean(shares(run.fine.csv("alone"))),
      agent_fine = measure.mean(shares(run.fine.csv("there"))),
    }
  end,
  expect = {
    { "object", what = "share of an object's avoidance that a person takes, mean of 12", source = "1; band ours",
      band = { 0.95, 1.05 } },
    { "object_least", what = "least of the 12", source = "1; band ours", band = { 0.9, 1.1 } },
    { "object_most", what = "greatest of the 12", source = "1; band ours", band = { 0.9, 1.1 } },
    { "agent", what = "share between two people that one of them takes, mean of 12", source = "0.5; band ours",
      band = { 0.475, 0.525 } },
    { "agent_least", what = "least of the 12", source = "0.5; band ours", band = { 0.45, 0.55 } },
    { "agent_most", what = "greatest of the 12", source = "0.5; band ours", band = { 0.45, 0.55 } },
    { "other", what = "share that the other takes, mean of 12", source = "0.5; band ours", band = { 0.475, 0.525 } },
    { "object_fine", what = "objects, dt 0.01 s", source = "1; band ours", band = { 0.95, 1.05 } },
    { "agent_fine", what = "people, dt 0.01 s", source = "0.5; band ours", band = { 0.475, 0.525 } },
  },
  pictures = { way = { "alone.png", "there.png", "back.png" } },
}
