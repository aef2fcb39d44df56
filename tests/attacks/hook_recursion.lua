-- expects: run A
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function()
    local function f() return 1 + f() end
    return f() > 0
  end } } } }
