-- A court of two halves, with a ball at a point and groups by name, for the tests of who plays dodge-ball.
return function(ball, groups)
  return {
    places = {
      red_court = { polygon = { { -8, -4 }, { 0, -4 }, { 0, 4 }, { -8, 4 } } },
      blue_court = { polygon = { { 0, -4 }, { 8, -4 }, { 8, 4 }, { 0, 4 } } },
    },
    bodies = {
      {
        name = "ball", tags = { "ball" }, at = ball,
        shape = { sphere = { radius = 0.11 } }, mass = 0.4, restitution = 0.7,
      },
    },
    groups = groups,
  }
end
