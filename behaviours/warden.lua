-- Waits at the assembly point for the classes' reports. When one misses somebody, looks where nobody teaches, sends out
-- whom it finds, and tells that class's teacher for each who comes.
local mine = memory { classes = 0, asked_by = nobody, found = 0 }
local complete, missing, here = told "complete", told "missing", told "here"
local class_done = { when = complete, set = { classes = mine.classes + 1 } }
local pass_on = { when = here, set = { found = mine.found + 1 }, tell = { mine.asked_by, "here" } }

return machine {
  name = "warden", version = 1, start = "Wait",
  own = { assembly = "yard", search = "washroom" },
  defaults = { speed = 1.5, perception = 40 },

  states = {
    Wait = { steer = hold,
      class_done, pass_on,
      { to = "Search", when = missing, set = { asked_by = missing.sender } } },

    Search = { steer = field(own.search), colour = "vermilion",
      class_done, pass_on,
      { when = missing },
      { to = "Back", when = inside(own.search) & after(1), tell = { neighbours("pupils"):within(6), "out" } } },

    Back = { steer = field(own.assembly),
      class_done, pass_on,
      { when = missing },
      { to = "Wait", when = arrived(own.assembly) } },
  },
}
