-- Stands in a queue, is served at its head, and leaves. Customers are served in the order in which they come.
local crowd = require "crowd"

return machine {
  name = "customer", version = 2, start = "Queue",
  defaults = { speed = normal(1.2, 0.15, 0.7, 1.6), time_gap = crowd.time_gap, perception = 3, radius = 0.22 },

  states = {
    Queue = { steer = queue(own.counter), max_speed = 1.2,
      { to = "Service", when = first_in(own.counter) & near(own.counter, 0.5) } },

    -- The customer who is served still heads the queue; the next one waits behind.
    Service = { steer = queue(own.counter), lasts = uniform(4, 8),
      { to = "Leave",   when = lasted } },

    Leave = { steer = seek(own.exit),
      { to = "Gone",    when = inside(own.exit) } },

    Gone = { removes = true },
  },
}
