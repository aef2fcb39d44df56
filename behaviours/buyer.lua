-- Buys where it is cheap and near, and not again where it just was; goes home with three things, or when the money is
-- short.
local mine = memory { purse = 20, bought = 0, stall = nobody }
local sold, sold_out = told "sold", told "sold_out"
local offer = best("sellers", 0 - theirs(other, "price") - 0.3 * distance(other)):where("stock", 1)
local done = mine.bought:at_least(3) | mine.purse:below(4)

return machine {
  name = "buyer", version = 1, start = "Look",
  own = { range = "market", way_out = "gate" },
  defaults = { speed = normal(1.2, 0.2, 0.7, 1.7), perception = 15 },

  states = {
    Look = { steer = wander(own.range), speed = 0.6,
      { to = "Leave", when = done | after(30) },
      { to = "Go",    when = after(1) & sees(offer) & ~same(offer, mine.stall), set = { stall = offer } } },

    Go = { steer = seek(mine.stall),
      { to = "Ask",   when = near(mine.stall, 1.6) },
      { to = "Look",  when = after(25) } },

    Ask = { steer = hold, face = mine.stall, tell = { mine.stall, "buy" },
      { to = "Look",  when = sold, set = { purse = mine.purse - sold.price, bought = mine.bought + 1 } },
      { to = "Look",  when = sold_out | after(30) } },

    Leave = { steer = field(own.way_out),
      { to = "Gone",  when = inside(own.way_out) } },

    Gone = { removes = true },
  },
}
