-- expects: run print is limited
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function(me)
    for i = 1, 100 do print(me.id, i) end
    return false
  end } } } }
