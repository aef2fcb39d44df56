-- expects: run A
-- Makes values of the language in every call, as if memory had no end.
local kept = now
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function()
    local e = kept.speed
    for _ = 1, 10000 do e = e + kept.speed end
    return false
  end } } } }
