-- Stands in a row of people with the tag `row`: is pushed and goes back like a stander, but steps aside for none of
-- them.
return machine {
  name = "row_stander", version = 1, start = "Stand",
  defaults = { perception = 1.5, horizon = 0.2 },

  states = {
    Stand = { steer = hold, ignore = "row" },
  },
}
