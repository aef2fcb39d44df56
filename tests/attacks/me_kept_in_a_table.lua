-- expects: run frozen
-- The table is frozen by then: nothing is kept from one call to the next.
local kept = {}
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function(me)
    if kept[1] then return kept[1].speed > 0 end
    kept[1] = me
    return kept[1].speed > 1e9
  end } } } }
