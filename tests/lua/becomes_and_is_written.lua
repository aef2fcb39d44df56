-- Two write to the memory of a third in the step in which it becomes another machine: what has the
-- same name there gets it, and nothing else.
local mine = memory { tall = 0, told = 0 }
return machine { name = "becomes_and_is_written", version = 1, start = "Begin",
  defaults = { perception = 5 }, states = {
  Begin = { { to = "Turn", when = after(0.1) } },
  Turn = { become = "parts/turned", on_enter = function(me)
    for _, other in ipairs(me.neighbours) do other.told, other.tall = 5, 9 end
  end, { to = "Begin", when = mine.tall:at_least(1e9) & mine.told:at_least(1e9) } } } }
