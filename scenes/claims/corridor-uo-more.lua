local corridor = require "corridor"

return claim(corridor({
  id = "F3b", title = "The same corridor with other widths",
  text = "Half a metre of entrance lets people in one by one, from a crowd that waits before it; an exit of 0.95 m fills the "
    .. "corridor.",
}, {
  { "050-180-180", 0.66, 0.53, 1.35 },
  { "180-180-095", 1.02, 2.36, 0.46 },
}))
