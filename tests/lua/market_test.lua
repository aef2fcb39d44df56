-- seller.lua and buyer.lua: those who ask are served in order, at the price that they are told.
test("what is paid is taken, what is sold is gone, and all go home", function()
  local s = scene "market.yaml"
  local stock, paid, bought = 0, 0, 0
  for _, one in ipairs(s:agents "sellers") do stock = stock + one.stock end
  s:run(30)
  for _, one in ipairs(s:agents "buyers") do paid, bought = paid + 20 - one.purse, bought + one.bought end
  local takings, left = 0, 0
  for _, one in ipairs(s:agents "sellers") do takings, left = takings + one.takings, left + one.stock end
  local waiting = stock - left - bought -- sold, and the message is on its way, or the buyer has left
  truthy(bought > 20, "people buy")
  truthy(waiting >= 0 and waiting <= 6, "what is bought was sold")
  truthy(takings >= paid - 1e-6, "what is paid was taken")
  s:run(150)
  equal(#s:agents "buyers", 0)
end)

-- Three who ask one after the other at a stall that is still closed.
test("who asked first is served first", function()
  local late = [[local mine = memory { price = 3, stock = 9, takings = 0, customer = nobody }
    local buy = told "buy"
    return machine { name = "seller", start = "Closed", public = { "price", "stock" }, states = {
      Closed = { steer = hold, { to = "Open", when = after(4) } },
      Open = { steer = hold, { to = "Serve", when = buy, set = { customer = buy.sender } } },
      Serve = { steer = hold, lasts = 1,
        { to = "Open", when = lasted, tell = { mine.customer, "sold", price = 1 } } } } }]]
  local asker = [[local mine = memory { served = 0 }
    return machine { name = "asker", start = "Wait", own = { turn = 1 }, defaults = { perception = 20 }, states = {
      Wait = { steer = hold, { to = "Ask", when = after(own.turn) } },
      Ask = { steer = hold, tell = { nearest "stall", "buy" },
        { to = "Served", when = told "sold", set = { served = now.time } } },
      Served = { steer = hold } } }]]
  local groups = { stall = { behaviour = late, at = { { 0, 0 } }, tags = { "stall" } } }
  for n, turn in ipairs { 3, 1, 2 } do
    groups["asker" .. n] = { behaviour = asker, at = { { 3, n } }, set = { turn = turn } }
  end
  local s = scene { groups = groups }
  s:run(10)
  local at = {}
  for n = 1, 3 do at[n] = s:agents("asker" .. n)[1].served end
  truthy(at[2] > 4 and at[2] < at[3] and at[3] < at[1], "in the order in which they asked")
end)
