return machine { name = "timers", version = 1, start = "Wait", states = {
  Wait = { lasts = uniform(1, 1.2),
    { to = "Fail", when = lasted & ~after(1) | after(1.4) }, { to = "Pass", when = lasted } },
  Pass = {}, Fail = {} } }
