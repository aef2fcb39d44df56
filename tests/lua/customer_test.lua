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

-- A counter at the end of a lane between walls, into which people come from a hall. Returns how many were
-- passed over by one who stood behind, how many were served, and how many are still there.
local function serve_lane(width, seed, group)
  local half = width / 2
  group.count, group["in"], group.spacing = 16, "hall", 0.9
  local s = scene({
    places = {
      hall = { polygon = { { 6, -3 }, { 14, -3 }, { 14, 3 }, { 6, 3 } } },
      counter = { queue = { { 0.3, 0 }, { 13, 0 } }, spacing = 0.6 },
      exit = { polygon = { { -6, -3 }, { -4, -3 }, { -4, 3 }, { -6, 3 } } },
    },
    walls = { { line = { { 5, half }, { 0, half }, { 0, 6 } } }, { line = { { 5, -half }, { 0, -half }, { 0, -6 } } } },
    groups = { people = group },
  }, { seed = seed })
  local past, served, passed_over = {}, 0, 0
  for _ = 1, 4000 do
    s:step()
    for _, a in ipairs(s:agents()) do
      if a.state:find "Serv" and not past[a.id] then
        past[a.id], served = true, served + 1
        for _, other in ipairs(s:agents()) do -- all others in the lane are behind, or beside
          if not past[other.id] and other.x < a.x - 0.3 then passed_over = passed_over + 1 end
        end
      end
    end
  end
  return passed_over, served, s:count()
end

for seed = 1, 3 do
  for _, width in ipairs { 0.7, 1.2 } do
    test(("all are served at the end of a lane of %.1f m, from the front, seed %d"):format(width, seed), function()
      for _, group in ipairs {
        { behaviour = "customer.lua", set = { counter = "counter", exit = "exit" } },
        { journey = { { queue = "counter", service = "uniform(2, 4)" }, { exit = "exit" } } },
      } do
        local passed_over, served, left_over = serve_lane(width, seed, group)
        truthy(passed_over <= 2, passed_over .. " of 120 pairs were served by those behind first")
        equal(served, 16)
        equal(left_over, 0)
      end
    end)
  end
end

test("two who come from different sides are served in the order in which they come to the end", function()
  local s = scene({
    places = { counter = { queue = { { 0, 0 }, { 12, 0 } }, spacing = 0.7 },
      exit = { point = { -3, -4 }, radius = 1 } },
    groups = {
      far = { behaviour = "customer.lua", at = { { 9, 4 } }, set = { counter = "counter", exit = "exit" } },
      near = { behaviour = "customer.lua", at = { { 2, -2 } }, set = { counter = "counter", exit = "exit" } },
    },
  }, { seed = 1 })
  s:reaches("Service", { agents = "near", within = 6 })
  equal(s:entered("Service", { agents = "far" }), 0)
  s:reaches("Service", { agents = "far", within = 20 })
end)

test("people who queue at a point are served, too, one after another", function()
  local s = scene({
    places = { counter = { point = { 0, 0 } }, exit = { point = { -8, -4 }, radius = 1 } },
    groups = { customers = { behaviour = "customer.lua", at = { { 3, 0 }, { 4, 0 }, { 5, 0 } },
      set = { counter = "counter", exit = "exit" } } },
  }, { seed = 1 })
  s:reaches("Gone", { within = 60 })
end)

test("who has no place to queue at is at the head of nothing", function()
  local s = scene({
    places = { post = { point = { 0, 0 } } },
    groups = { lost = { at = { { 3, 0 }, { 4, 0 } }, behaviour = [[
      return machine { name = "lost", start = "Wait", states = {
        Wait = { steer = queue(goal), { to = "Head", when = first_in(goal) | joined(goal) } },
        Head = { steer = hold } } }
    ]] } },
  }, { seed = 1 })
  for _ = 1, 40 do s:step() end
  equal(s:entered("Head"), 0)
end)

test("without a queue to stand in the scene is refused", function()
  refused({ groups = { c = { behaviour = "customer.lua", at = { { 0, 0 } } } } }, "no group that runs customer sets it")
end)
