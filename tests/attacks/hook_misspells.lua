-- expects: run too long
-- Suggestions cost more than the instructions that ask for them.
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function(me)
    while true do pcall(function() return me.sped end) end
  end } } } }
