-- expects: run too long
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function()
    table.sort({ 2, 1 }, function() while true do end end)
  end } } } }
