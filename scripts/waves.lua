-- Waves that travel along a row of equally spaced points, found in the series of values at the points. Claims call it.
--
-- The series are cut into windows of 16 s. In each, the Fourier components of all series are added with the delays of a
-- wave of speed c, once in each direction (a slant stack):
--
--     P(c, f) = |sum over points j of X_j(f) exp(2 pi i f j d / c)|^2,   d the distance of two points
--
-- P(c, f) - P(-c, f), where positive, is power that travels one way, and the other way where it is negative: a
-- standing oscillation, however strong, has equal power in both, and of two trains of waves that meet all the time the
-- weaker may be missed. The sum over all frequencies and windows, divided by that of a pure wave, is the share of
-- variance that travels at the speed c. Noise has such a share too, by chance. So the share is compared with those of
-- surrogates: the same data with each series shifted in a circle by a random time, which keeps values and spectra and
-- leaves no relation between points.
local measure = require "measure"

local waves = {}

local WINDOW = 16 -- s
local HIGHEST = 0.5 -- 1/s: highest frequency
local SPEEDS = { 0.3, 0.4, 0.5, 0.65, 0.8, 1, 1.25, 1.6, 2, 2.5, 3 } -- m/s
local SURROGATES = 99

-- Values in a window.
local function count_values(every) return math.floor(WINDOW / every + 0.5) end

-- Generator of equally likely integers from 0 to n - 1 (Park and Miller), the same in every run.
local function make_generator()
  local state = 1
  return function(n)
    state = state * 48271 % 2147483647
    return state % n
  end
end

-- Fails unless the values are often enough for the highest frequency, finite, and as many in each series.
local function check_series(series, every)
  if not (every > 0 and every <= 0.5 / HIGHEST) then
    error(("waves: a value every %g s, but frequencies up to %g Hz need one every %g s"):format(every, HIGHEST,
      0.5 / HIGHEST), 0)
  end
  for j = 1, #series do
    if #series[j] ~= #series[1] then
      error(("waves: series 1 has %d values, series %d has %d"):format(#series[1], j, #series[j]), 0)
    end
    for i = 1, #series[j] do
      local value = series[j][i]
      if value - value ~= 0 then error(("waves: value %d of series %d is %g"):format(i, j, value), 0) end
    end
  end
end

-- A share over that which chance gives; 0 without a share, as of constant series.
local function compare_shares(found, by_chance)
  return found > 0 and found / measure.quantile(by_chance, 0.95) or 0
end

-- The series without its trend, with deviation 1; a constant one becomes 0.
local function standardise(series)
  local out = measure.detrended(series)
  local deviation = measure.deviation(out)
  for i = 1, #out do out[i] = deviation > 0 and out[i] / deviation or 0 end
  return out
end

-- Factors of component b of a window of `length` values: a Hann window times the cosine and the sine.
local function make_factors(length, bins)
  local factors = {}
  for b = 1, bins do
    local cosines, sines = {}, {}
    for i = 1, length do
      local angle, taper = 2 * math.pi * b * i / length, 0.5 - 0.5 * math.cos(2 * math.pi * (i - 0.5) / length)
      cosines[i], sines[i] = taper * math.cos(angle), -taper * math.sin(angle)
    end
    factors[b] = { cosines = cosines, sines = sines }
  end
  return factors
end

-- The `length` values of a series from `first` on, without their trend.
local function cut(series, first, length)
  local part = {}
  for i = 1, length do part[i] = series[first + i - 1] end
  return measure.detrended(part)
end

-- Fourier components of a list.
local function transform(list, factors)
  local re, im = {}, {}
  for b = 1, #factors do
    local x, y, cosines, sines = 0, 0, factors[b].cosines, factors[b].sines
    for i = 1, #list do
      x, y = x + list[i] * cosines[i], y + list[i] * sines[i]
    end
    re[b], im[b] = x, y
  end
  return { re = re, im = im }
end

-- Components of all series in windows that overlap by half.
local function transform_windows(series, length, factors)
  local windows = {}
  for first = 1, #series[1] - length + 1, length // 2 do
    local window = {}
    for j = 1, #series do window[j] = transform(cut(series[j], first, length), factors) end
    windows[#windows + 1] = window
  end
  return windows
end

-- The series, each shifted in a circle by a random number of values.
local function shift_series(series, draw)
  local out = {}
  for j = 1, #series do
    local n = #series[j]
    local shift, shifted = draw(n), {}
    for i = 1, n do shifted[i] = series[j][(i - 1 + shift) % n + 1] end
    out[j] = shifted
  end
  return out
end

-- P(c, f) - P(-c, f) of a window, for the component b, c > 0 towards later points. `turn` is 2 pi f d / c.
local function measure_excess(window, b, turn)
  local c, s = math.cos(turn), math.sin(turn)
  local up_re, up_im, down_re, down_im, x, y = 0, 0, 0, 0, 1, 0
  for j = 1, #window do
    local re, im = window[j].re[b], window[j].im[b]
    up_re, up_im = up_re + re * x - im * y, up_im + re * y + im * x
    down_re, down_im = down_re + re * x + im * y, down_im - re * y + im * x
    x, y = x * c - y * s, x * s + y * c
  end
  return up_re * up_re + up_im * up_im - down_re * down_re - down_im * down_im
end

-- What P(c, f) would add up to if all variance were one wave.
local function sum_power(windows)
  local sum = 0
  for w = 1, #windows do
    for j = 1, #windows[w] do
      local part = windows[w][j]
      for b = 1, #part.re do sum = sum + part.re[b] * part.re[b] + part.im[b] * part.im[b] end
    end
  end
  return #windows[1] * sum
end

-- Powers that travel at one speed towards later and towards earlier points. Components whose waves are shorter than two
-- distances of points are left out, as their direction is ambiguous.
local function sum_excess(windows, speed, apart)
  local up, down = 0, 0
  for w = 1, #windows do
    for b = 1, #windows[w][1].re do
      local frequency = b / WINDOW
      if frequency > speed / (2 * apart) then break end
      local excess = measure_excess(windows[w], b, 2 * math.pi * frequency * apart / speed)
      if excess > 0 then up = up + excess else down = down - excess end
    end
  end
  return up, down
end

-- Greatest shares of variance that travel towards later and towards earlier points, and their speeds, m/s.
local function find_shares(windows, apart)
  local power = sum_power(windows)
  local up, down = { share = 0, speed = 0 }, { share = 0, speed = 0 }
  for i = 1, #SPEEDS do
    local later, earlier = sum_excess(windows, SPEEDS[i], apart)
    if later > up.share * power then up = { share = later / power, speed = SPEEDS[i] } end
    if earlier > down.share * power then down = { share = earlier / power, speed = SPEEDS[i] } end
  end
  return up, down
end

-- Waves in series of values taken `every` s at points `apart` m apart. Returns two tables, of waves towards later and
-- of those towards earlier points: `share` of the variance, `speed` in m/s, and `ratio`, the share over the 95th
-- percentile of the surrogates'. A ratio below 1 is no evidence of waves. Series shorter than a window give nil.
function waves.find(series, every, apart)
  if #series < 2 or apart <= 0 then error("waves: a direction needs two points, and a distance between them", 0) end
  check_series(series, every)
  local length = count_values(every)
  if #series[1] < length then return nil, nil end
  local factors, standard = make_factors(length, math.floor(HIGHEST * WINDOW + 0.5)), {}
  for j = 1, #series do standard[j] = standardise(series[j]) end
  local up, down = find_shares(transform_windows(standard, length, factors), apart)
  local draw, by_chance_up, by_chance_down = make_generator(), {}, {}
  for i = 1, SURROGATES do
    local later, earlier = find_shares(transform_windows(shift_series(standard, draw), length, factors), apart)
    by_chance_up[i], by_chance_down[i] = later.share, earlier.share
  end
  up.ratio = compare_shares(up.share, by_chance_up)
  down.ratio = compare_shares(down.share, by_chance_down)
  return up, down
end

-- Deviation of positive series about their trend within windows, as a share of their means, over all of them. A wave
-- with a share s of the variance has an amplitude of sqrt(2 s) times that. nil: the series are shorter than a window.
function waves.sway(series, every)
  check_series(series, every)
  local length, sum, count = count_values(every), 0, 0
  for j = 1, #series do
    local mean = measure.mean(series[j])
    for first = 1, #series[j] - length + 1, length // 2 do
      sum, count = sum + (measure.deviation(cut(series[j], first, length)) / mean) ^ 2, count + 1
    end
  end
  return count > 0 and math.sqrt(sum / count) or nil
end

return waves
