-- expects: run a function changed 'kept'
-- The source check does not see this assignment; the one at run time does, and takes it back.
local kept = 0
return machine { name = "m", start = "A", states = {
  A = { steer = hold, { to = "B", when = function()
    local kept = (function() kept = kept + 1 return kept end)()
    return kept > 1
  end } },
  B = { steer = hold } } }
