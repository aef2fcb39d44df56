-- expects: harmless
-- Always within its budget; but all together it is too much for one step.
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function()
    for _ = 1, 45000 do end
    return false
  end } } } }
