local corridor = require "corridor"

return claim(corridor({
  id = "F3b", title = "The same corridor with other widths",
  text = "Half a metre of entrance lets people in one by one, from a crowd that waits before it; an exit of 0.95 m fills the "
    .. "corridor.",
  tried = { "The eagerness of calm people who have a goal lets the corridors of F5 and the exits of F3 pass nearly as many as "
    .. "recorded, and a fifth too many through the exit of 0.95 m; without it 1.05 pass there. Their rivals before the exit add a "
    .. "tenth." },
}, {
  { "050-180-180", 0.66, 0.53, 1.35 },
  { "180-180-095", 1.02, 2.36, 0.46 },
}))
