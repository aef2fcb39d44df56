return machine { name = "functions", version = 1, start = "Walk", states = {
  Walk = { steer = function(me) return -1 - 0 * me.x, 0 end,
    { to = "Pass", when = function(me) return me.x < 11 and me.state == "Walk" end } },
  Pass = { steer = hold } } }
