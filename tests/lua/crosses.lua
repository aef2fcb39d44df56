return machine { name = "crosses", version = 1, start = "Walk", states = {
  Walk = { steer = seek "post",
    { to = "Pass", when = crosses "mid" }, { to = "Fail", when = after(15) } },
  Pass = { steer = hold }, Fail = {} } }
