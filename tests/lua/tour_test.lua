-- guide.lua and tourist.lua: the tour follows, listens where a story is told, and nobody stays behind.
local function museum()
  return scene({
    places = {
      a = { point = { 4, 11 }, radius = 1 }, b = { point = { 16, 11 }, radius = 1 },
      stops = { set = { "a", "b" } },
    },
    walls = { { line = { { 10, 0 }, { 10, 9 } } } },
    groups = {
      guides = { behaviour = "guide.lua", at = { { 6, 4 } }, tags = "guides", set = { stops = "stops" } },
      tourists = { behaviour = "tourist.lua", at = { { 4, 3 }, { 5, 2 }, { 3, 4 }, { 4, 5 }, { 6, 2 } },
        tags = "tourists" },
    },
  }, { seed = 4 })
end

test("a story is told, and everybody listens to it", function()
  local s = museum()
  s:reaches("Tell", { agents = "guides", within = 40 })
  s:reaches("Listen", { agents = "tourists", within = 120 })
end)

test("after two minutes all are near the guide", function()
  local s = museum()
  s:run(120)
  local guide = s:agents("guides")[1]
  for _, t in ipairs(s:agents("tourists")) do
    truthy(math.abs(t.x - guide.x) < 8 and math.abs(t.y - guide.y) < 8, "tourist " .. t.id .. " is lost")
  end
end)
