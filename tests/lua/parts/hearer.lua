-- What a told agent becomes: it takes the two messages that came before.
local mine = memory { sum = 0 }
local go = told "go"
return machine { name = "hearer", start = "Wait", states = {
  Wait = { steer = hold,
    { when = go, set = { sum = mine.sum + go.number } },
    { to = "Pass", when = after(0.5) & mine.sum:is(6) } },
  Pass = { steer = hold },
} }
