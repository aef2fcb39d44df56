local measure = require "measure"

local STOREYS = { "ground", "first", "second" }
-- People of all storeys with this speed on level ground.
local function of_speed(speed)
  local set = {}
  for i = 1, #STOREYS do set["groups." .. STOREYS[i] .. ".set.speed"] = speed end
  return set
end

local CASES = { { "slow", 0.5 }, { "middle", 0.75 }, { "fast", 1 }, { "spread", "uniform(0.5, 1)" } }
local runs, quick, expect, measured = {}, {}, {}, {}
for i = 1, #CASES do
  local name, speed = CASES[i][1], CASES[i][2]
  runs[name] = { scene = "../rimea-08.yaml", seeds = "101-103", duration = 500, set = of_speed(speed) }
  quick[name] = { seeds = 1 }
  expect[i] = { name, unit = "s", what = "until the last is out, at " .. speed .. " m/s", source = "none", reported = true }
  if i < 4 then measured[i] = { speed, name } end
end
expect[#expect + 1] = { "rises", what = "speeds with which it takes no less time than with the one before",
  source = "time falls as speed rises", band = { 0, 0 } }
expect[#expect + 1] = { "between", what = "time with speeds from 0.5 to 1 m/s, between those of the two: 0 to 1",
  source = "ours", band = { 0, 1 } }
expect[#expect + 1] = { "out", what = "people who get out, the fewest of all cases", source = "all 448", band = { 448, 448 } }

return claim {
  id = "R8", title = "RiMEA 8: a building of three storeys, and the speed of its people",
  source = "RiMEA 4.1.1, test 8, by notes of it; the plan is ours: 112 rooms of 2 x 3 m, one stair from each storey, one exit",
  text = "448 people leave a building by stairs, at 0.5, 0.75 or 1 m/s on level ground, or at speeds between. The faster they "
    .. "are, the sooner the last is out.",
  level = "normal", held_out = measure.walking_law .. "; the time gap on stairs on a stair of 2 m",
  runs = runs, quick = quick,
  null = { text = "0.75 m/s in all cases", set = of_speed(0.75), seeds = 1 },
  measure = function(run)
    local out, people, times = {}, {}, {}
    for i = 1, #CASES do
      local exit = run[CASES[i][1]].summary.probes.exit
      out[CASES[i][1]], people[i], times[i] = exit.last, exit.forward, exit.last
    end
    out.rises = (times[2] >= times[1] and 1 or 0) + (times[3] >= times[2] and 1 or 0)
    out.between = (times[4] - times[3]) / (times[1] - times[3])
    out.out = measure.least(people)
    return out
  end,
  expect = expect,
  plots = { { name = "time", title = "RiMEA 8: time and speed", x = "speed on level ground (m/s)", y = "until the last is out (s)",
    { "Jostle", figures = measured } } },
}
