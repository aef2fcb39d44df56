-- expects: run m > state A
-- The names in a traceback are texts of the script.
local t = { ["\27[2J"] = function() error("x") end }
local function f() local r = t["\27[2J"]() return r end
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function() local r = f() return r end } } } }
