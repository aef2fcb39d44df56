-- The queue at the Black Stone: who joins, and how.
local mine = memory { touched = false }

return patch "tawaf" {
  states = {
    Circle = { change = {
      ToStone = {
        when = crosses "start_line" & near("black_stone", 10)
          & ~density("black_stone"):above(settings.crowding) & ~mine.touched,
        chance = settings.chance,
      },
    } },
    ToStone = { push = 0, perception = 3,
      insert_before = { Circle = { to = "Circle", when = pushed:above(200), id = "squeezed" } } },
  },
}
