return machine { name = "queues", version = 1, start = "Line", states = {
  Line = { steer = queue "row",
    { to = "Served", when = first_in("row") & near("row", 0.4) } },
  Served = { steer = seek "post", { to = "Pass", when = after(1) } },
  Pass = { steer = seek "post" } } }
