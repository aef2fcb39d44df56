local measure = require "measure"

-- The western doors are shut by setting the ends of their leaves; their people go to the eastern ones.
local shut = {
  ["walls.4.line.1.0"] = 8, ["walls.4.line.1.1"] = 0, ["walls.5.line.1.0"] = 8, ["walls.5.line.1.1"] = 20,
}

return claim {
  id = "I9", title = "IMO 9: two doors against four",
  source = "IMO MSC.1/Circ.1533, test 9",
  text = "A thousand people leave a hall by four doors of 1 m, then by two of them. It takes about twice as long.",
  level = "calm", held_out = measure.walking_law,
  runs = measure.calm({
    four = { scene = "../imo-09.yaml", seeds = "101-110" },
    two = { scene = "../imo-09.yaml", seeds = "101-110", set = shut },
  }, "from_south_west", "from_south_east", "from_north_west", "from_north_east"),
  quick = { four = { seeds = 1 }, two = { seeds = 1 } },
  null = { text = "two doors in both runs", runs = { four = { set = shut } } },
  measure = function(run)
    local function last(probes, names)
      local list, people = {}, 0
      for i = 1, #names do
        local door = probes[names[i]]
        list[#list + 1], people = door.last, people + door.forward
      end
      return measure.most(list), people
    end
    local four, all = last(run.four.summary.probes, { "west_south", "east_south", "west_north", "east_north" })
    local two, both = last(run.two.summary.probes, { "east_south", "east_north" })
    return { ratio = two / four, four = four, two = two, people = math.min(all, both) }
  end,
  expect = {
    { "ratio", what = "time by two doors over time by four", source = "about 2; 1.6 to 2.4 by JuPedSim", band = { 1.6, 2.4 } },
    { "people", what = "people who got out, the fewer of both", source = "all 1000", band = { 1000, 1000 } },
    { "four", unit = "s", what = "until the last is out, four doors", source = "none", reported = true },
    { "two", unit = "s", what = "the same, two doors", source = "none", reported = true },
  },
  pictures = { four = { "density.png", "west_south.png" }, two = { "density.png" } },
}
