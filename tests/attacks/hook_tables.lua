-- expects: run stopped
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function()
    local t = {}
    while true do t[#t + 1] = { t } end
  end } } } }
