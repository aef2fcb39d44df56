-- expects: load-error
local state = { steer = hold }
for i = 1, 100000 do state[i] = { to = "A", when = after(i) } end
return machine { name = "m", start = "A", states = { A = state } }
