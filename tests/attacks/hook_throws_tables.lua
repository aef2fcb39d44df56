-- expects: run needs a text
return machine { name = "m", start = "A", states = { A = { steer = hold,
  { to = "A", when = function() error({}) end } } } }
