-- customer.lua: one at a time is served, in the order in which the queue formed.
local function counter(count)
  return scene({
    places = {
      hall = { polygon = { { 3, -4 }, { 9, -4 }, { 9, 4 }, { 3, 4 } } },
      counter = { queue = { { 0, 0 }, { 12, 0 } }, spacing = 0.7 },
      exit = { point = { -3, -4 }, radius = 1 },
    },
    groups = {
      customers = { behaviour = "customer.lua", count = count, fill = "grid", spacing = 1, ["in"] = "hall",
        set = { counter = "counter", exit = "exit" } },
    },
  }, { seed = 5 })
end

test("one at a time is served, for four to eight seconds", function()
  local s = counter(6)
  local since
  for _ = 1, 1200 do
    s:step()
    local served = s:count("Service")
    truthy(served <= 1, "two are served at once")
    if served == 1 and not since then
      since = s:time()
    elseif served == 0 and since then
      truthy(s:time() - since > 3.9 and s:time() - since < 8.2, "served for " .. s:time() - since .. " s")
      since = nil
    end
  end
  equal(s:entered("Leave"), 6)
end)

test("everybody is served and leaves", function()
  counter(6):reaches("Gone", { within = 90 })
end)

test("without a queue to stand in the scene is refused", function()
  refused({ groups = { c = { behaviour = "customer.lua", at = { { 0, 0 } } } } }, "no group that runs customer sets it")
end)
