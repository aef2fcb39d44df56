-- What becomes_and_is_written becomes: `told` is where `tall` was, and `kept` where `told` was.
local mine = memory { told = 0, kept = 7 }
return machine { name = "turned", version = 1, start = "Look", states = {
  Look = { { to = "Pass", when = after(0.1) & mine.told:at_least(5) & mine.told:at_most(5)
    & mine.kept:at_least(7) & mine.kept:at_most(7) } },
  Pass = {} } }
