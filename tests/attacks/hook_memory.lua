-- expects: run stopped
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function()
    local s = "x"
    for _ = 1, 60 do s = s .. s end
    return true
  end } } } }
