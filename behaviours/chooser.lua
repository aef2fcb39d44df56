-- Leaves by the nearer of two doors, or, once it would take too long, by the farther one: from time to time people
-- compare their way to each door and those who stand before it.
local crowd = require "crowd"

-- Seconds to get out by a door: the way there, then those in front, of whom two a second get through.
local function way_out(door, front) return distance(door) / own.speed + count(front) / 2 end

local gain = way_out(own.near, own.near_front) - way_out(own.far, own.far_front)
local walks = { speed = crowd.by_headway, horizon = crowd.foresight, push_when = crowd.held_up }

return machine {
  name = "chooser", version = 1, start = "ToNear",
  defaults = { speed = normal(1.34, 0.26, 0.6, 2.2), perception = 3, radius = 0.19, push = crowd.nudge },

  states = {
    ToNear = { steer = seek(own.near), speed = walks.speed, horizon = walks.horizon, push_when = walks.push_when,
      lasts = uniform(2, 6),
      { to = "AtNear", when = near(own.near, 2.5) },
      { to = "ToFar",  when = lasted & gain:above(10) },
      { to = "ToNear", when = lasted, id = "again" } },

    AtNear = { steer = seek(own.near), speed = crowd.at_door, horizon = 0.3, push_when = crowd.slow_at_door,
      { to = "Walk",   when = crosses(own.near) | near(own.near, 0.1) },
      { to = "ToNear", when = ~near(own.near, 3) } },

    ToFar = { steer = seek(own.far), speed = walks.speed, horizon = walks.horizon, push_when = walks.push_when,
      lasts = uniform(2, 6),
      { to = "AtFar",  when = near(own.far, 2.5) },
      { to = "ToNear", when = lasted & gain:below(-10) },
      { to = "ToFar",  when = lasted, id = "again" } },

    AtFar = { steer = seek(own.far), speed = crowd.at_door, horizon = 0.3, push_when = crowd.slow_at_door,
      { to = "Walk",  when = crosses(own.far) | near(own.far, 0.1) },
      { to = "ToFar", when = ~near(own.far, 3) } },

    Walk = { steer = field(own.goal), speed = walks.speed, horizon = walks.horizon, push_when = walks.push_when,
      { to = "Gone", when = inside(own.goal) } },

    Gone = { removes = true },
  },
}
