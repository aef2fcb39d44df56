-- Steps per second of processor time, on one core, without drawing.
local function frames(run) return run.summary.steps / run.summary.cpu_s end
-- Simulated time per wall time of the steps alone.
local function pace(run) return run.summary.simulated_s / run.summary.cpu_s end

local function run(scene, duration, set)
  return { scene = "../" .. scene .. ".yaml", duration = duration, set = set, seeds = 1 }
end

return claim {
  id = "13", title = "Faster than the paper, and than real time",
  source = "Kim et al. 2014, Table 2: frames a second on one core of a 3.4 GHz i7",
  text = "Steps a second on one core, and how much faster than real time. On a processor that is shared, with "
    .. "others at work, these are lower bounds.",
  level = "normal",
  no_null = "figures of speed have no cause that could be taken out",
  held_out = "figures of speed: no constant was chosen on what people do here",
  runs = {
    bottlenecks = run("two-bottlenecks-full", 30), wall = run("wall-breaking", 20),
    -- 200 single blocks, on which 1200 people press from the start.
    loose = run("wall-breaking", 20, { ["bodies.wall.shape.blocks.bond"] = 0.001, ["groups.people.behaviour"] = "presser.lua",
      ["places.crowd.polygon.1.0"] = -0.3, ["places.crowd.polygon.2.0"] = -0.3 }),
    office = run("office", 20, { ["groups.people.count"] = 1200 }),
    balls = run("dodgeball-500", 20), tawaf = run("tawaf", 20),
  },
  quick = { tawaf = { duration = 10 } },
  measure = function(run)
    return {
      bottlenecks = frames(run.bottlenecks), wall = frames(run.wall), loose = frames(run.loose), office = frames(run.office),
      balls = frames(run.balls), tawaf = frames(run.tawaf),
      slowest = math.min(pace(run.bottlenecks), pace(run.wall), pace(run.loose),
        pace(run.office), pace(run.balls), pace(run.tawaf)),
    }
  end,
  expect = {
    { "bottlenecks", unit = "1/s", what = "two bottlenecks, 1000 agents, all there from the start", source = "829.7", band = { 829.7 } },
    { "wall", unit = "1/s", what = "wall breaking, 1200 agents, 200 blocks that are glued", source = "50.1", band = { 50.1 } },
    { "loose", unit = "1/s", what = "the same, 200 single blocks, pressed on from the start", source = "50.1", band = { 50.1 } },
    { "office", unit = "1/s", what = "office, 1200 agents at the start, 65 bodies", source = "69.0", band = { 69 } },
    { "balls", unit = "1/s", what = "dodge ball, 500 balls", source = "90.9", band = { 90.9 } },
    { "tawaf", unit = "1/s", what = "Tawaf, 35,000 agents", source = "5.7", band = { 5.7 } },
    { "slowest", what = "the slowest of them, times faster than real time", source = "ours", band = { 1 } },
  },
}
