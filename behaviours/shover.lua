-- Stands, then gives the agent ahead one shove of at most `strength` newtons, which lasts `time` seconds.

-- Force of a shove, as a share of its maximum, over the share of its duration: measured on the last of five people in a
-- row (Feldmann and Adrian 2023, as force per mass over 0.725 s).
local measured = {
  { 0, 0 }, { 0.14, 0.18 }, { 0.26, 0.17 }, { 0.33, 0.84 }, { 0.40, 1 }, { 0.47, 0.98 }, { 0.54, 0.79 },
  { 0.66, 0.78 }, { 0.73, 0.42 }, { 0.87, 0.30 }, { 0.94, 0.06 }, { 1, 0 },
}

-- Piecewise linear function through the knots, as an expression of x: each knot adds a change of slope from there on.
local function through(knots, x)
  local value, slope = knots[1][2], 0
  for i = 1, #knots - 1 do
    local from, to = knots[i], knots[i + 1]
    local rises = (to[2] - from[2]) / (to[1] - from[1])
    value = value + (rises - slope) * max(0, x - from[1])
    slope = rises
  end
  return value
end

return machine {
  name = "shover", version = 1, start = "Wait",
  defaults = { perception = 1, horizon = 0.2 },

  states = {
    Wait = { steer = hold,
      { to = "Shove", when = after(own.at) } },

    Shove = { steer = hold, push_toward = own.ahead, push_weight = "nearest", push_reach = 1, lasts = own.time,
      push = own.strength * max(0, through(measured, time_in_state / own.time)),
      { to = "Done", when = lasted } },

    Done = { steer = hold },
  },
}
