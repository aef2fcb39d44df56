local corridor = require "corridor"

return claim(corridor({
  id = "F3", title = "A corridor of 1.8 m with an entrance and an exit",
  text = "A narrow entrance leaves the corridor free; a narrow exit fills it, and people shuffle. They wait in a crowd before "
    .. "the entrance of 1 m; where the exit is the narrower they come in where and when the camera saw them first.",
  tried = { "Without rivals (walking.rivals = 16) 0.84 pass the exit of 0.7 m, and people stand a fifth denser before it than recorded "
    .. "ones and walk a third slower; with them 0.99 pass." },
}, {
  { "100-180-180", 1.32, 1.12, 1.21 },
  { "180-180-120", 1.34, 2.04, 0.68 },
  { "180-180-070", 0.95, 2.98, 0.37 },
}))
