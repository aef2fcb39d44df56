-- companion.lua: parties keep together on the way to their goal.
local function square(party)
  return scene({
    places = {
      west = { polygon = { { 0, 0 }, { 8, 0 }, { 8, 16 }, { 0, 16 } } },
      gate = { polygon = { { 48, 2 }, { 52, 2 }, { 52, 14 }, { 48, 14 } } },
    },
    groups = {
      families = { behaviour = "companion.lua", count = 24, party = party, fill = "hex", ["in"] = "west",
        spacing = 1, set = { goal = "gate" } },
    },
  }, { seed = 2 })
end

-- Mean distance of the members of a party, those who were born one after another.
local function spread(s, party)
  local sum, pairs_met, people = 0, 0, s:agents()
  for _, a in ipairs(people) do
    for _, b in ipairs(people) do
      if a.id < b.id and a.id // party == b.id // party then
        sum = sum + math.sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y))
        pairs_met = pairs_met + 1
      end
    end
  end
  return sum / pairs_met
end

test("parties of four stay closer than the same people on their own", function()
  local together, alone = square(4), square(1)
  together:run(25)
  alone:run(25)
  truthy(spread(together, 4) < 0.8 * spread(alone, 4),
    spread(together, 4) .. " m together, " .. spread(alone, 4) .. " m alone")
end)

test("everybody arrives", function()
  square(4):reaches("Gone", { within = 90 })
end)
