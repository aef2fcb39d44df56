local corridor = require "corridor"

return claim(corridor({
  id = "F5", title = "Wider corridors, with entrances and exits as wide",
  text = "Nothing is narrower than the corridor, and more people pass a metre of it than where it has a narrow entrance or "
    .. "exit (F3). People, told to walk through at ease, come in where and when the camera saw them first.",
  tried = { "Calm people without rivals (walking.rivals = 16) pass 1.45 per metre and second; as eager as normal ones 1.7, but "
    .. "then the narrow exits of F3 and F3b let a fifth to a third too many out." },
}, {
  { "240-240-240", 1.65, 1.84, 0.92 },
  { "300-300-300", 1.74, 1.82, 0.97 },
}))
