-- expects: load-error
-- Many states, each with many transitions, all misspelt.
local states = {}
for i = 1, 400 do
  local state = {}
  for k = 1, 60 do state[k] = { to = "T" .. k, wen = 1 } end
  states["S" .. i] = state
end
return machine { name = "m", start = "S1", states = states }
