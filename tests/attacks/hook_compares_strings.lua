-- expects: stop far longer
local a, b = ("x"):rep(2 ^ 19) .. "a", ("x"):rep(2 ^ 19) .. "b"
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function()
    while true do local _ = a < b end
  end } } } }
