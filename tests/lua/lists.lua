-- Lists: each agent remembers whom it met, in order, and three numbers, of which the oldest goes.
local mine = memory { met = list(2, nobody), times = list(3), seen = 0 }
local met, times = mine.met, mine.times
local other = nearest "people"

return machine { name = "lists", version = 1, start = "Empty", defaults = { perception = 30 }, states = {
  Empty = { steer = hold,
    { to = "Push", when = met.size:is(0) & times.size:is(0) & ~exists(met.first) & times.last:is(0)
        & ~met:contains(other),
      set = { met = met:push(other), times = times:push(1) } } },
  Push = { steer = hold,
    { to = "More", when = met.size:is(1) & met:contains(other) & same(met.first, other) & same(met.last, other)
        & times.first:is(1) & times:contains(1) & ~times:contains(2) & met.first.x:is(12),
      set = { met = met:push(nearest "ball"), times = times:push(2) } } },
  More = { steer = hold,
    { to = "Full", when = met.size:is(2) & times.last:is(2),
      set = { met = met:push("post"), times = times:push(3) } } },
  Full = { steer = hold, -- the first of met went
    { to = "Over", when = met.size:is(2) & ~met:contains(other) & same(met.first, nearest "ball")
        & near(met.last, 20) & times.size:is(3), set = { met = met:push(nobody), times = times:push(4) } } },
  Over = { steer = hold,
    { to = "Less", when = met.size:is(2) & times.first:is(2) & times.last:is(4),
      set = { met = met:remove(nearest "ball"), times = times:remove(3) } } },
  Less = { steer = hold,
    { to = "Hook", when = met.size:is(1) & times.size:is(2) & times.first:is(2) & times.last:is(4) } },
  Hook = { steer = hold,
    on_enter = function(me)
      local list = me.times
      list[#list + 1] = #me.met + (me.met[1] == "post" and 100 or 0)
      me.times, me.met = list, { me.neighbours[1], "post" }
    end,
    { to = "None", when = times.last:is(101) & met:contains(other) & met:contains("post"),
      set = { met = met:clear() } } },
  None = { steer = hold,
    { to = "Pass", when = met.size:is(0) & times.size:is(3) } },
  Pass = { steer = hold },
} }
