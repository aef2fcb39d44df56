-- The claim that the scenes corridor-uo-*.yaml share: people walk one way through a corridor, with entrances and exits
-- of other widths.
local measure = require "measure"

-- Returns a table for `claim`. `words`: id, title, text, tried. `cases`: for each case the widths of entrance,
-- corridor and exit, cm, and the source's specific flow, 1/(m s), density, 1/m2, and speed, m/s.
return function(words, cases)
  local runs, quick, expect, pictures, measured, source = {}, {}, {}, {}, {}, {}
  for i = 1, #cases do
    local name, flow, density, speed = table.unpack(cases[i])
    runs[name], quick[name] = { scene = "../corridor-uo-" .. name .. ".yaml", seeds = "101-110" }, { seeds = 3 }
    pictures[name] = { "paths.png", "middle.png" }
    local function add(figure, unit, what, value, share)
      expect[#expect + 1] = measure.expected(figure .. " " .. name, unit, what .. ", " .. name, value, share)
    end
    add("flow", "1/(m s)", "specific flow in the corridor", flow, 0.15)
    add("density", "1/m2", "density in its middle", density, 0.25)
    add("speed", "m/s", "speed there", speed, 0.25)
    measured[i], source[i] = { density, "speed " .. name }, { density, speed }
  end
  return {
    id = words.id, title = words.title, text = words.text,
    source = "Zhang et al. 2011, doi 10.1088/1742-5468/2011/06/P06004 (unidirectional, open; widths in cm), measured "
      .. "with the scenes' own probes",
    level = "calm",
    calibrated = measure.walking_law,
    runs = runs, quick = quick, null = measure.half_gap(),
    measure = function(run)
      local out = {}
      for name in pairs(runs) do
        local probes = run[name].summary.probes
        out["flow " .. name] = probes.line.specific_flow
        out["density " .. name] = probes.middle.density
        out["speed " .. name] = probes.middle.speed
      end
      return out
    end,
    expect = expect, tried = words.tried,
    plots = { { name = "diagram", title = "Speed in the middle of the corridor, at the densities of the source",
      x = "density measured by the source (1/m²)", y = "mean speed (m/s)",
      { "Jostle, the same widths", figures = measured }, { "Zhang et al. 2011", points = source } } },
    pictures = pictures,
  }
end
