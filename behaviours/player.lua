-- A person drives this agent; touching the ball kicks it at an opponent. By ORCA: not fit for capacities.
local ball = nearest "ball"

return machine {
  name = "player", version = 1, start = "Play",
  defaults = { speed = 3, max_speed = 4, perception = 20, mass = 70 },

  states = {
    Play = { steer = player, approach = ball,
      kick = { ball, at = nearest "opponents", impulse = 2 + 2 * now.speed } },
  },
}
