-- expects: harmless
-- A view of a neighbour, asked for another's names and memory.
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function(me)
    for _, other in ipairs(me.neighbours) do
      pcall(function() other.turns = 0 / 0 end)
      pcall(function() other.x = 1 end)
      pcall(function() return other[{}] end)
      pcall(function() other.neighbours[1].x = 1 end)
    end
    return false
  end } } } }
