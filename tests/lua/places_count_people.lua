return machine { name = "places_count_people", version = 1, start = "Wait", states = {
  Wait = { { to = "Pass", when = count("yard"):is(3) & density("yard"):below(0.01) } },
  Pass = {} } }
