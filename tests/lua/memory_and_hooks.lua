local mine = memory { count = 0, flag = false }
return machine { name = "memory_and_hooks", version = 1, start = "A", states = {
  A = { on_enter = function(me) me.count = me.count + 1 end,
    { to = "Pass", when = mine.count:at_least(3) & mine.flag }, { to = "B", when = after(0.1) } },
  B = { on_exit = function(me) me.flag = me.count > 1 end,
    { to = "A", when = after(0.1) } },
  Pass = {} } }
