-- Arithmetic for claims: on lists of numbers, and on the columns of probes' CSV files.
local measure = {}

-- Ids of the claims on which the constants of the walking law (core/walking.md) were chosen. These claims name them as
-- their calibration; all other claims on real crowds name them as data from which they were held out.
measure.walking_law = "the walking law's constants were chosen on seeds 201 to 216 and 301 to 318 of B1 to B4, C1, "
  .. "F1 to F3, F3b, L1 and W, and touched up once 101 to 110 were seen; seven of them for torsos on "
  .. "101 to 103 of these, F5 and L2"

-- Returns the null of a claim on people who walk by the walking law: they walk by ORCA, the engine's rule for states
-- without a time gap. `groups`: their names.
function measure.by_orca(...)
  local set = {}
  for _, group in ipairs { ... } do set["groups." .. group .. ".set.time_gap"] = 0 end
  return { text = "everybody walks by ORCA instead of the walking law", set = set, seeds = 1 }
end

-- Returns the null of a claim on speed over density: the people of the group `people` keep half the time gap to who is
-- ahead.
function measure.half_gap()
  local set = { ["groups.people.set.time_gap"] = 0.461 }
  return { text = "people keep half the time gap, 0.461 s", set = set, seeds = 1 }
end

-- Returns the null of a claim on how people use the width of their way: all take the shortest way, however crowded.
function measure.shortest_way()
  return { text = "ways do not avoid people who are held up", set = { ["walking.crowd_slowing"] = 0 }, seeds = 1 }
end

-- Returns the runs of a claim on a test of IMO or NIST, whose greatest flows are low: the people of these groups are
-- calm, unless a run sets their haste.
function measure.calm(runs, ...)
  for _, run in pairs(runs) do
    local set = {}
    for _, group in ipairs { ... } do set["groups." .. group .. ".set.haste"] = "calm" end
    for path, value in pairs(run.set or {}) do set[path] = value end
    run.set = set
  end
  return runs
end

-- Ids of the claims on which the Tawaf's behaviour was chosen; it walks by ORCA, so its claims have no level of haste.
measure.tawaf = "the Tawaf's chances, durations, speeds and pushes were chosen on seed 1 of 6-7, 8, 9 and 10, "
  .. "chances and gates on seed 101 of 6-7 and 10, too; that a gate is drawn at random, "
  .. "and that slow people push, by 40 N per m/s, were chosen on none"

-- A claim's run of the 35,000 of the Tawaf, which several claims share; its last half is measured. `run` may give
-- scene, seeds, duration (600 s: the outermost need some 350 s for a circuit) and set.
function measure.tawaf_run(run)
  local duration = run.duration or 600
  local set = {}
  for _, figure in ipairs { "heatmap", "probes.fields", "probes.narrow" } do set[figure .. ".from"] = duration / 2 end
  for path, value in pairs(run.set or {}) do set[path] = value end
  return { scene = run.scene or "../tawaf.yaml", seeds = run.seeds or 1, duration = duration, first = true, set = set }
end

function measure.mean(list)
  local sum = 0
  for i = 1, #list do sum = sum + list[i] end
  return sum / #list
end

-- Standard deviation of the population of which the list is a sample (n - 1).
function measure.deviation(list)
  local mean, sum = measure.mean(list), 0
  for i = 1, #list do sum = sum + (list[i] - mean) ^ 2 end
  return math.sqrt(sum / (#list - 1))
end

function measure.least(list)
  local best = math.huge
  for i = 1, #list do best = math.min(best, list[i]) end
  return best
end

function measure.most(list)
  local best = -math.huge
  for i = 1, #list do best = math.max(best, list[i]) end
  return best
end

-- The value below which a share of the list lies, linear between ranks.
function measure.quantile(list, share)
  local sorted = {}
  for i = 1, #list do sorted[i] = list[i] end
  table.sort(sorted)
  local at = 1 + share * (#sorted - 1)
  local low = math.floor(at)
  local high = math.min(low + 1, #sorted)
  return sorted[low] + (at - low) * (sorted[high] - sorted[low])
end

function measure.median(list) return measure.quantile(list, 0.5) end

-- Number of crossings, in both directions, of the lines of all flow probes whose names begin with a prefix.
function measure.crossings(probes, prefix)
  local sum = 0
  for name, probe in pairs(probes) do
    if name:sub(1, #prefix) == prefix then sum = sum + probe.forward + probe.back end
  end
  return sum
end

-- Least-squares slope of y over x.
function measure.slope(x, y)
  local mx, my, sxx, sxy = measure.mean(x), measure.mean(y), 0, 0
  for i = 1, #x do
    sxx = sxx + (x[i] - mx) * (x[i] - mx)
    sxy = sxy + (x[i] - mx) * (y[i] - my)
  end
  return sxy / sxx
end

-- Band around a value: `share` of the value to either side.
function measure.about(value, share) return { (1 - share) * value, (1 + share) * value } end

-- Row of a claim's `expect`: a figure whose mean must lie within a share of the source's value.
function measure.expected(figure, unit, what, value, share)
  return { figure, unit = unit, what = what, source = string.format("%.2f", value), band = measure.about(value, share) }
end

-- Root mean square of the relative deviations from expected values.
function measure.rms(list, expected)
  local sum = 0
  for i = 1, #list do sum = sum + (list[i] / expected[i] - 1) ^ 2 end
  return math.sqrt(sum / #list)
end

-- Cumulative distribution functions of x.
function measure.uniform_share(least, greatest)
  return function(x) return math.max(0, math.min(1, (x - least) / (greatest - least))) end
end

-- Computed by the series of the error function, which converges for all x; 0 or 1 beyond 6 deviations.
function measure.normal_share(mean, deviation)
  return function(x)
    local z = (x - mean) / deviation
    if math.abs(z) > 6 then return z > 0 and 1 or 0 end
    local term, sum, n = z, z, 1
    while math.abs(term) > 1e-12 do
      term, n = term * z * z / (2 * n + 1), n + 1
      sum = sum + term
    end
    return 0.5 + sum * math.exp(-z * z / 2) / math.sqrt(2 * math.pi)
  end
end

function measure.lognormal_share(mean, deviation)
  local normal = measure.normal_share(mean, deviation)
  return function(x) return normal(math.log(x)) end
end

function measure.weibull_share(shape, scale) return function(x) return 1 - math.exp(-(x / scale) ^ shape) end end

-- Logarithm of the gamma function: Stirling's series above 8, the recurrence below.
local function log_gamma(x)
  local below = 0
  while x < 8 do below, x = below + math.log(x), x + 1 end
  local series = 1 / (12 * x) - 1 / (360 * x ^ 3) + 1 / (1260 * x ^ 5)
  return (x - 0.5) * math.log(x) - x + 0.5 * math.log(2 * math.pi) + series - below
end

function measure.gamma_share(shape, scale)
  return function(x)
    local at, n = x / scale, 0
    local term = 1 / shape
    local sum = term
    while term > 1e-14 * sum do
      n = n + 1
      term = term * at / (shape + n)
      sum = sum + term
    end
    return sum * math.exp(shape * math.log(at) - at - log_gamma(shape))
  end
end

-- Probability that a sample of the distribution differs from it at least as much as the list, by the test of Kolmogorov
-- and Smirnov (series of its limit, with Stephens's correction for short lists).
function measure.kolmogorov_smirnov(list, share)
  local sorted, n, farthest = {}, #list, 0
  for i = 1, n do sorted[i] = list[i] end
  table.sort(sorted)
  for i = 1, n do
    local s = share(sorted[i])
    farthest = math.max(farthest, s - (i - 1) / n, i / n - s)
  end
  local lambda, chance = (math.sqrt(n) + 0.12 + 0.11 / math.sqrt(n)) * farthest, 0
  for k = 1, 100 do chance = chance + 2 * (-1) ^ (k - 1) * math.exp(-2 * (k * lambda) ^ 2) end
  return lambda < 0.3 and 1 or math.max(0, math.min(1, chance))
end

-- Speed of a push along a row of people, m/s, from the columns of a probe of displacement: slope of their positions
-- over the times when they have moved 5 cm.
function measure.front(row)
  local x, t = {}, {}
  for i = 1, row.n do
    x[i], t[i] = row.x[i], row.onset[i]
  end
  return measure.slope(t, x)
end

-- Number of items of a list, from `first` on, that are not less than the item before: 0 means a steady fall.
function measure.rises(list, first)
  local count = 0
  for i = (first or 1) + 1, #list do
    if list[i] >= list[i - 1] then count = count + 1 end
  end
  return count
end

-- Number of passages of a flow before `time`: N(t).
function measure.passed(flow, time)
  local count = 0
  for i = 1, flow.n do
    if flow.direction[i] > 0 and flow.time[i] <= time then count = count + 1 end
  end
  return count
end

-- The list without its linear trend: residuals of a least-squares line.
function measure.detrended(list)
  local order, out = {}, {}
  for i = 1, #list do order[i] = i end
  local slope, middle, mean = measure.slope(order, list), (#list + 1) / 2, measure.mean(list)
  for i = 1, #list do out[i] = list[i] - mean - slope * (i - middle) end
  return out
end

return measure
