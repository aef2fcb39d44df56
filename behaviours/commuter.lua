-- Waits on the platform until the doors open, boards, and rides standing: then it is a stander.
return machine {
  name = "commuter", version = 1, start = "Wait",
  defaults = { speed = normal(1.3, 0.2, 0.8, 1.8), perception = 3, push = 30 },

  states = {
    Wait = { steer = hold, face = own.door,
      { to = "Board", when = after(own.opens) } },

    Board = { steer = field(own.car), speed = own.speed * clamp(1.4 - density_here / 6, 0.3, 1),
      { to = "Ride",  when = inside(own.car) & (density_here:above(3) | after(12)) } },

    Ride = { become = "stander" },
  },
}
