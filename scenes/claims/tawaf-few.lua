local measure = require "measure"

-- Circuits of people who came in during the run and left before its end, at their most: a way out that goes clockwise
-- takes none away.
local function turns_of(turns, seconds)
  local done, fewer, more, clockwise = 0, 0, 0, 0
  for i = 1, turns.n do
    if turns.since[i] > 1 and turns["until"][i] < seconds - 1 then
      done = done + 1
      fewer = fewer + (turns.greatest_running[i] < 7 and 1 or 0)
      more = more + (turns.greatest_running[i] >= 8.3 and 1 or 0)
    end
    clockwise = clockwise + (turns.least_running[i] <= -1 and 1 or 0)
  end
  return done, fewer, more, clockwise
end

return claim {
  id = "10", title = "Seven circuits, counter-clockwise, and few on their way out",
  source = "Kim et al. 2014, Fig. 11",
  text = "Two thousand pilgrims for half an hour. Whoever came in during the run and has left made seven circuits "
    .. "from the line on, and the way to it and out again; nobody went round clockwise. Each leaves by one "
    .. "of five gates, drawn at random.",
  calibrated = measure.tawaf,
  runs = { few = { scene = "../tawaf-few.yaml", seeds = 1, first = true }, tawaf = measure.tawaf_run { seeds = 3 } },
  quick = false,
  null = { text = "whoever comes in has one circuit counted already, and so makes six",
    runs = { few = { set = { ["sources.0.memory.laps"] = 1 } } }, seeds = 1 },
  measure = function(run)
    local done, fewer, more, clockwise = turns_of(run.few.csv("turns"), run.few.summary.simulated_s)
    local all = run.tawaf.summary
    return {
      leaving = all.states.tawaf.Exit / all.agents, done = done, fewer = fewer, more = more, clockwise = clockwise,
    }
  end,
  expect = {
    { "leaving", what = "share of the 35,000 who have finished and are on their way to a gate (state Exit), at the end",
      source = "about 0.02; band ours", band = { 0.01, 0.04 } },
    { "done", what = "people who came in during the run and have left", source = "ours", band = { 10 } },
    { "fewer", what = "of them, who made fewer than seven", source = "0", band = { 0, 0 } },
    { "more", what = "of them, who made more, the way to the line and out aside", source = "0", band = { 0, 0 } },
    { "clockwise", what = "people who went a lap clockwise", source = "0", band = { 0, 0 } },
  },
  pictures = { few = { "turns.png" } },
  tried = {
    "leaving by the nearest gate, and walking on with the stream until it is near: 3.8 %, with the gate not drawn at random",
  },
}
