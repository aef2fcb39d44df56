-- Waits for its pre-movement time, then leaves by one of two exits: it prefers the shorter way, and the exit that more
-- people whom it sees have chosen; `used_to` is a bonus for the first exit, out of habit, m. If it sees that its exit
-- is shut it turns to the other one.
local crowd = require "crowd"
local others = neighbours("anyone"):in_state("ToSecond") - neighbours("anyone"):in_state("ToFirst")
local second_is_better = distance(own.first) - distance(own.second) + own.sway * others - own.used_to -- metres

return machine {
  name = "leaver", version = 1, start = "Wait",
  defaults = { speed = normal(1.34, 0.26, 0.6, 2.2), time_gap = crowd.time_gap, perception = 20, neighbours = 16,
    radius = 0.19, push = crowd.nudge },

  states = {
    Wait = { steer = hold, -- pre-movement time: from the alarm to the first step, s
      { to = "Choose", when = after(own.premovement) } },

    Choose = { steer = hold,
      { to = "ToSecond", when = second_is_better:above(0) },
      { to = "ToFirst" } },

    ToFirst = { steer = field(own.first), push_when = crowd.held_up,
      { to = "Out",      when = inside(own.first) },
      { to = "ToSecond", when = shut(own.first_door) & ~shut(own.second_door) } },

    ToSecond = { steer = field(own.second), push_when = crowd.held_up,
      { to = "Out",      when = inside(own.second) },
      { to = "ToFirst",  when = shut(own.second_door) & ~shut(own.first_door) } },

    Out = { removes = true },
  },
}
