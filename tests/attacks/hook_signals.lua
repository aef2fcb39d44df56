-- expects: acts too long
-- Signals without end, each of a name of its own.
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function(me)
    for i = 1, 100000 do me.signal("name" .. i) end
    return false
  end } } } }
