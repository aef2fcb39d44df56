local waves = require "waves"

-- Waves of the density in slices 1 m deep, 1 to 10 m behind the wall.
local function find_waves(run)
  local densities = {}
  for k = 1, 10 do densities[k] = run.csv("behind_" .. k).density end
  return waves.find(densities, 0.25, 1)
end

return claim {
  id = "3w", title = "Waves behind a wall that hardly moves",
  source = "Kim et al. 2014, Fig. 7b",
  text = "Room runs through the crowd that presses on the heavy wall of claim 3b in waves. scripts/waves.lua finds "
    .. "them in the density over place and time: the share of its variance that travels at one speed, over the 95th "
    .. "percentile of what chance gives. Not more than 1 is no evidence of waves.",
  level = "keen",
  calibrated = "as claim 3",
  runs = { heavy = { scene = "../wall-heavy.yaml", seeds = 3, first = true } },
  quick = { heavy = { duration = 90 } },
  null = { text = "forces off", set = { ["forces.enabled"] = false } },
  measure = function(run)
    local back, front = find_waves(run.heavy)
    return {
      backward = back.ratio, backward_speed = back.speed, backward_share = back.share,
      forward = front.ratio, forward_speed = front.speed, forward_share = front.share,
      standing = run.heavy.summary.probes.behind_2.standing,
    }
  end,
  expect = {
    { "backward", what = "share of variance that travels from the wall, over that by chance",
      source = "waves run to the back; 1 is ours", band = { 1 } },
    { "backward_share", what = "the share itself", reported = true },
    { "backward_speed", unit = "m/s", what = "its speed", reported = true },
    { "forward", what = "share of variance that travels to the wall, over that by chance", source = "ours",
      band = { 1 } },
    { "forward_share", what = "the share itself", reported = true },
    { "forward_speed", unit = "m/s", what = "its speed", reported = true },
    { "standing", what = "share of people 2 m behind the wall who stand", reported = true },
  },
  tried = {
    "What bounds it: from a minute on the crowd behind the wall is packed to 13 per m2, and two thirds of the people "
      .. "2 m behind it stand. No room is left that could travel: the density sways by 1 %, and waves in it are no "
      .. "stronger than by chance. People too soft for the density that they reach are a known limit.",
    "Without forces people stay at 6.5 per m2, and waves do run back, at 1.6 m/s, with a share of 0.24 to 0.29. So "
      .. "these come from people who step back and forward, not from pushes.",
  },
  pictures = { heavy = { "behind_6.png" } },
}
