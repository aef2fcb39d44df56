-- What is told waits while an agent runs a machine that never asks for it, and may become one that does. What neither
-- asks for is dropped. Of a list that is shorter there the newest items are kept.
local mine = memory { times = list(4) }
return machine { name = "becomes_and_hears", version = 1, start = "Start", defaults = { perception = 20 }, states = {
  Start = { steer = hold,
    { every = 0.1, set = { times = mine.times:push(now.time) } },
    { to = "Talk", when = after(0.5), tell = { neighbours("people"), "go", number = 3 } } },
  Talk = { steer = hold, tell = { neighbours("people"), "noise" },
    { to = "Turn", when = after(0.5) } },
  Turn = { become = "parts/hearer" },
} }
