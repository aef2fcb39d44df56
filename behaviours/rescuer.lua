-- Goes to the nearest casualty, takes hold, waits for a second rescuer, and carries the casualty to a refuge with it;
-- then comes back for the next one. By ORCA: not fit for capacities.
local lying   = nearest("casualties"):in_state("Lie")
local carried = nearest("casualties"):in_state("Carried")
local safe    = nearest("casualties"):in_state("Safe")
local anyone  = nearest "casualties"

return machine {
  name = "rescuer", version = 1, start = "Fetch",
  defaults = { speed = 1.4, perception = 40, neighbours = 16, mass = normal(85, 8) },

  states = {
    Fetch = { steer = seek(lying), approach = lying, grasp = lying, grip = 600,
      { to = "Lift", when = has(anyone) } },

    Lift = { steer = hold, approach = anyone, grasp = anyone, grip = 600,
      { to = "Carry", when = has(carried) },
      { to = "Fetch", when = ~has(anyone) } },

    Carry = { steer = field(own.refuge), speed = 0.9, approach = anyone, grasp = anyone, grip = 600,
      { to = "Leave", when = has(safe) | ~has(anyone) } },

    Leave = { steer = hold, -- lets go
      { to = "Fetch", when = after(0.5) } },
  },
}
