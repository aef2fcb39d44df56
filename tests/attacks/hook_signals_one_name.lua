-- expects: acts too long
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function(me)
    while true do me.signal("here") end
  end } } } }
