-- Patch of the queue at the Black Stone: who joins it, and how.
local manners = require "gentle-queue:manners"
local mine = memory { touched = false }

return patch "tawaf" {
  states = {
    Circle = { change = {
      ToStone = {
        when = crosses "start_line" & near("black_stone", 10)
          & manners.has_room("black_stone", settings.crowding) & ~mine.touched,
        chance = settings.chance,
      },
    } },
    ToStone = { push = 0, perception = 3,
      insert_before = { Circle = { to = "Circle", when = manners.squeezed, id = "squeezed" } } },
    Queue = { push = 0, perception = 3,
      insert_before = { Circle = { to = "Circle", when = manners.squeezed, id = "squeezed" } } },
  },
}
