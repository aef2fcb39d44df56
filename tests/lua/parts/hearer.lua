-- What a told agent becomes: it takes the two messages that came before.
local mine = memory { sum = 0, times = list(2) }
local go = told "go"
return machine { name = "hearer", start = "Wait", states = {
  Wait = { steer = hold,
    { when = go, set = { sum = mine.sum + go.number } },
    { to = "Pass", when = after(0.5) & mine.sum:is(6)
        & mine.times.size:is(2) & mine.times.first:above(0.35) & mine.times.last:above(0.45) } },
  Pass = { steer = hold },
} }
