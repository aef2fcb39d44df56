-- waves.lua: planted waves are found with their speed and direction; noise and standing oscillations are not.
local waves = require "waves"

local state = 7
local function noise() -- from -0.5 to 0.5
  state = state * 48271 % 2147483647
  return state / 2147483647 - 0.5
end

-- 10 series of 70 s, 0.25 s and 1 m apart.
local function plant(value)
  local series = {}
  for j = 1, 10 do
    series[j] = {}
    for i = 1, 280 do series[j][i] = 10 + value(j, 0.25 * i) end
  end
  return series
end

-- A sum of pulses without a period, as a function of time.
local function make_pulses()
  local starts, tau = {}, 2 * math.pi
  for i = 1, 12 do starts[i] = { 0.05 + 0.25 * (noise() + 0.5), tau * noise() } end
  return function(t)
    local sum = 0
    for i = 1, #starts do sum = sum + math.sin(tau * starts[i][1] * t + starts[i][2]) / 4 end
    return sum
  end
end

test("a planted wave is found with its speed, and not the other way", function()
  local pulses = make_pulses()
  local later, earlier = waves.find(plant(function(j, t) return pulses(t - j / 1.6) + noise() end), 0.25, 1)
  truthy(later.ratio > 3)
  near(later.speed, 1.6, 0.5)
  truthy(earlier.ratio < 0.5)
  later, earlier = waves.find(plant(function(j, t) return pulses(t + j / 0.8) + noise() end), 0.25, 1)
  truthy(earlier.ratio > 3)
  near(earlier.speed, 0.8, 0.2)
  truthy(later.ratio < 0.5)
end)

test("trains of both directions that take turns are found both", function()
  local function turns(j, t) return math.sin(2 * math.pi * (t < 35 and t - j or t + j) / 5) end
  local later, earlier = waves.find(plant(turns), 0.25, 1)
  truthy(later.ratio > 1.2)
  near(later.speed, 1, 0.3)
  truthy(earlier.ratio > 1.2)
  near(earlier.speed, 1, 0.3)
end)

test("noise has no waves, but for the one of twenty that chance makes", function()
  local found = 0
  for _ = 1, 5 do
    local later, earlier = waves.find(plant(noise), 0.25, 1)
    found = found + (later.ratio > 1 and 1 or 0) + (earlier.ratio > 1 and 1 or 0)
    truthy(later.ratio < 1.5)
    truthy(earlier.ratio < 1.5)
  end
  truthy(found <= 2)
end)

test("an oscillation that stands has no waves, nor one of all points at once", function()
  local function sway(t) return math.sin(2 * math.pi * t / 6) + 0.5 * noise() end
  local function standing(j, t) return sway(t) * math.cos(2 * math.pi * j / 5.7) + 0.5 * noise() end
  local later, earlier = waves.find(plant(standing), 0.25, 1)
  truthy(later.ratio < 0.5)
  truthy(earlier.ratio < 0.5)
  later, earlier = waves.find(plant(function(_, t) return sway(t) end), 0.25, 1)
  truthy(later.ratio < 0.5)
  truthy(earlier.ratio < 0.5)
end)

test("sway is the deviation over the mean, without a trend", function()
  near(waves.sway(plant(function(_, t) return t / 7 + math.sin(2 * math.pi * t / 4) end), 0.25), 0.7071 / 15, 0.003)
  equal(waves.sway({ { 1, 2, 3 } }, 0.25), nil)
end)

test("the same data give the same figures, and short series none", function()
  local pulses = make_pulses()
  local series = plant(function(j, t) return pulses(t - j) end)
  equal(waves.find(series, 0.25, 1).ratio, waves.find(series, 0.25, 1).ratio)
  equal(waves.find({ { 1, 2, 3 }, { 1, 2, 3 } }, 0.25, 1), nil)
end)

test("constant series have no waves, and figures that are numbers", function()
  local later, earlier = waves.find(plant(function() return 0 end), 0.25, 1)
  equal(later.share, 0)
  equal(later.ratio, 0)
  equal(earlier.ratio, 0)
end)

test("series of which nothing can be said are errors", function()
  local function refuse(message, series, every, apart)
    local good, why = pcall(waves.find, series, every, apart)
    truthy(not good)
    truthy(why:find(message, 1, true))
  end
  local series = plant(noise)
  refuse("a value every 2 s, but frequencies up to 0.5 Hz need one every 1 s", series, 2, 1)
  refuse("two points", series, 0.25, 0)
  refuse("two points", { series[1] }, 0.25, 1)
  for i = 200, 280 do series[3][i] = nil end
  refuse("series 1 has 280 values, series 3 has 199", series, 0.25, 1)
  series = plant(noise)
  series[2][9] = 0 / 0
  refuse("value 9 of series 2 is", series, 0.25, 1)
  truthy(not pcall(waves.sway, series, 0.25))
end)
