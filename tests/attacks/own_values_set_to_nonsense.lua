-- expects: harmless
-- Each is refused, and nothing is changed.
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function(me)
    for _, v in ipairs { 0 / 0, math.huge, -math.huge, "3", {}, true, 1e300, -1 } do
      pcall(function() me.mass = v end)
      pcall(function() me.radius = v end)
      pcall(function() me.speed = v end)
      pcall(function() me.goal = v end)
      pcall(function() me.state = v end)
      pcall(function() me.id = v end)
    end
    return false
  end } } } }
