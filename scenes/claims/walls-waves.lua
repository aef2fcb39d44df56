local waves = require "waves"

-- Waves of the density in slices 1 m deep, 1 to 10 m behind the wall: from the wall, to it, and how much it sways.
local function find_waves(run)
  local densities = {}
  for k = 1, 10 do densities[k] = run.csv("behind_" .. k).density end
  local backward, forward = waves.find(densities, 0.25, 1)
  return backward, forward, waves.sway(densities, 0.25)
end

local function amplitude(wave, sway) return math.sqrt(2 * wave.share) * sway end

local function heavy(mode)
  return { scene = "../wall-heavy.yaml", seeds = 3, first = true, set = mode and { ["forces.mode"] = mode } }
end

return claim {
  id = "3w", title = "Waves behind a wall that hardly moves",
  source = "Kim et al. 2014, Fig. 7b",
  text = "Room runs through the crowd that presses on the heavy wall of claim 3b in waves. scripts/waves.lua finds "
    .. "them in the density over place and time: the share of its variance that travels at one speed, over the 95th "
    .. "percentile of what chance gives. Not more than 1 is no evidence of waves.",
  level = "keen",
  calibrated = "as claim 3",
  runs = { heavy = heavy(), printed = heavy("literal") },
  quick = { heavy = { duration = 90 }, printed = { duration = 90 } },
  null = { text = "forces off", runs = { heavy = { set = { ["forces.enabled"] = false } } } },
  measure = function(run)
    local backward, forward, sway = find_waves(run.heavy)
    local printed_backward, printed_forward, printed_sway = find_waves(run.printed)
    return {
      backward = backward.ratio, backward_speed = backward.speed, backward_amplitude = amplitude(backward, sway),
      forward = forward.ratio, forward_speed = forward.speed, forward_amplitude = amplitude(forward, sway),
      standing = run.heavy.summary.probes.behind_2.standing,
      printed_backward = printed_backward.ratio, printed_backward_amplitude = amplitude(printed_backward, printed_sway),
      printed_forward = printed_forward.ratio, printed_forward_amplitude = amplitude(printed_forward, printed_sway),
    }
  end,
  expect = {
    { "backward", what = "share of variance that travels from the wall, over that by chance",
      source = "waves run to the back; 1 is ours", band = { 1 } },
    { "backward_speed", unit = "m/s", what = "speed of these waves", reported = true },
    { "backward_amplitude", what = "their amplitude, as a share of the density", reported = true },
    { "forward", what = "share of variance that travels to the wall, over that by chance", source = "ours",
      band = { 1 } },
    { "forward_speed", unit = "m/s", what = "speed of these waves", reported = true },
    { "forward_amplitude", what = "their amplitude, as a share of the density", reported = true },
    { "standing", what = "share of people 2 m behind the wall who stand", reported = true },
    { "printed_backward", what = "by the equations as printed: share from the wall, over chance", reported = true },
    { "printed_backward_amplitude", what = "amplitude, as a share of the density", reported = true },
    { "printed_forward", what = "by the equations as printed: share to the wall, over chance", reported = true },
    { "printed_forward_amplitude", what = "amplitude, as a share of the density", reported = true },
  },
  tried = {
    "What bounds it: from a minute on the crowd behind the wall is packed to 13 per m2, and two thirds of the people "
      .. "2 m behind it stand. No room is left that could travel: the density sways by 1 %. People too soft for the "
      .. "density that they reach are a known limit, but not the only reason: discs with brace = 0, on seed 101, "
      .. "stand at 7 per m2 and the density sways by less than 0.05 %.",
    "The equations as printed do give waves that run back, at 1 to 2 m/s: of a fifth of the density while the crowd "
      .. "piles up, of 3 % from 50 s on, where they are measured.",
    "Without forces people stay at 6.5 per m2, and waves run back, at 1.6 to 2 m/s, but none to the wall. So the waves "
      .. "that run back are no evidence of pushing.",
  },
  pictures = { heavy = { "behind_6.png" } },
}
