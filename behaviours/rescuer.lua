-- Goes to the nearest casualty, takes hold, waits for a second rescuer, and carries the casualty to a refuge with it;
-- then comes back for the next one. By ORCA: not fit for capacities.
local lying   = nearest("casualties"):in_state("Lie")
local carried = holding:in_state("Carried")

return machine {
  name = "rescuer", version = 2, start = "Fetch",
  defaults = { speed = 1.4, perception = 40, neighbours = 16, mass = normal(85, 8) },

  states = {
    Fetch = { steer = seek(lying), approach = lying, grasp = lying, grip = 600,
      { to = "Lift",  when = exists(holding) } },

    Lift = { steer = hold, approach = holding, grasp = holding, grip = 600,
      { to = "Carry", when = sees(carried) },
      { to = "Fetch", when = ~exists(holding) } },

    Carry = { steer = field(own.refuge), speed = 0.9, approach = holding, grasp = holding, grip = 600,
      { to = "Leave", when = ~sees(carried) } },

    Leave = { steer = hold, -- lets go
      { to = "Fetch", when = after(0.5) } },
  },
}
