-- Sells at a stall: serves those who ask in the order in which they asked, and raises the price with each sale. Who
-- asks once all is sold is told so.
local mine = memory { price = 3, stock = 8, takings = 0, customer = nobody }
local buy = told "buy"

return machine {
  name = "seller", version = 1, start = "Open", public = { "price", "stock" },
  defaults = { speed = 0, perception = 6 },

  states = {
    Open = { steer = hold, face = mine.customer,
      { to = "Sold out", when = mine.stock:below(1) },
      { to = "Serve",    when = buy, set = { customer = buy.sender } } },

    Serve = { steer = hold, face = mine.customer, lasts = uniform(1, 3),
      { to = "Open", when = lasted, tell = { mine.customer, "sold", price = mine.price },
        set = { stock = mine.stock - 1, takings = mine.takings + mine.price, price = 1.1 * mine.price } } },

    ["Sold out"] = { steer = hold, colour = "grey",
      { when = buy, tell = { buy.sender, "sold_out" } } },
  },
}
