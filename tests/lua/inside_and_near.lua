local there = inside("post") & near("post", 0.6) & ~near("post", 0.01)
return machine { name = "inside_and_near", version = 1, start = "Walk", states = {
  Walk = { steer = seek "post", ignore = "people", { to = "Pass", when = there } },
  Pass = { steer = hold } } }
