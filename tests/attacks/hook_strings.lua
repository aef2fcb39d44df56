-- expects: run too long
local s = ("x"):rep(2 ^ 20)
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function()
    while true do s:find("y") end
  end } } } }
