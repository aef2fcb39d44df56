local other = nearest "people"
return machine { name = "targets", version = 1, start = "Look", states = {
  Look = { { to = "Pass", when = sees(other) & distance(other):below(3) & ~sees(nearest "ball") } },
  Pass = {} } }
