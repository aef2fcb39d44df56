-- Walks to a place in a square and stays. An agent with a `drive`, the speed in m/s at which its feet push, presses
-- on; the direction of its pressing turns towards that in which the crowd carries it, by up to 1 rad for each `carry`
-- metres: a polarity that aligns with the velocity, as Gu et al. (2025) propose. Agents without a drive stand.
local crowd = require "crowd"

local mine = memory { way = 0, at = 0, drive = 0, carry = 1 }

local function press(me)
  local past = me.time - me.at
  local east, north = math.cos(me.way), math.sin(me.way)
  me.way = me.way + (east * me.vy - north * me.vx) * past / me.carry
  me.at = me.time
  return me.drive * east, me.drive * north
end

return machine {
  name = "reveller", version = 1, start = "Come",
  defaults = { speed = normal(1.2, 0.2, 0.8, 1.7), time_gap = crowd.time_gap, push = crowd.nudge },

  states = {
    Come = { steer = field(one_of(own.spots)), push_when = crowd.held_up,
      { to = "Press", when = near(goal, 1.5) | stuck(8), set = { at = now.time } } },

    Press = { steer = press,
      { to = "Stand", when = ~mine.drive:above(0) } },

    Stand = { steer = hold },
  },
}
