-- Leaves by the nearer of two doors, or by the farther one if that is quicker: from time to time people compare their
-- way to each door and the number of people before it.
local crowd = require "crowd"

-- Time to get out by a door, s: for the way there, then for the people in front, of whom two a second pass it.
local function way_out(door, front) return distance(door) / own.speed + count(front) / 2 end

-- An agent that passes either door has left, also if the crowd carried it through the one that it had not chosen.
local through = crosses(own.near) | crosses(own.far)

-- So has one that came by a door which it was not told of, on a way round the crowd: nothing stands before the goal,
-- and that is nearer than both doors. From within, a door is always nearer than the goal beyond it.
local function goal_before(door) return (distance(own.goal) - distance(door)):below(0) end
local out = through | goal_before(own.near) & goal_before(own.far) & near(own.goal, 1e4)

local gain = way_out(own.near, own.near_front) - way_out(own.far, own.far_front)

return machine {
  name = "chooser", version = 3, start = "ToNear",
  defaults = { speed = normal(1.34, 0.26, 0.6, 2.2), time_gap = crowd.time_gap, perception = 3, radius = 0.19,
    push = crowd.nudge },

  states = {
    ToNear = { steer = field(own.near), push_when = crowd.held_up, lasts = uniform(2, 6),
      { to = "Walk",   when = out | near(own.near, 0.1) },
      { to = "ToFar",  when = lasted & gain:above(15) & ~near(own.near, 2.5) },
      { to = "ToNear", when = lasted, id = "again" } },

    ToFar = { steer = field(own.far), push_when = crowd.held_up, lasts = uniform(2, 6),
      { to = "Walk",   when = out | near(own.far, 0.1) },
      { to = "ToNear", when = lasted & gain:below(-15) & ~near(own.far, 2.5) },
      { to = "ToFar",  when = lasted, id = "again" } },

    Walk = { steer = field(own.goal), push_when = crowd.held_up,
      { to = "Gone", when = inside(own.goal) } },

    Gone = { removes = true },
  },
}
