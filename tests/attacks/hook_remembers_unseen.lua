-- expects: run a function changed 'kept'
-- The source check does not see this assignment, for it cannot tell two functions of one line apart; the one at
-- run time does, and takes it back.
local kept = 0
return machine { name = "m", start = "A", states = {
  A = { steer = hold,
    { to = "B", when = function() kept = kept + 1 return kept > 1 end, on_take = function() return kept end } },
  B = { steer = hold } } }
