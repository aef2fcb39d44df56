-- Somebody as a value: each agent remembers the one farthest north, the ball and a place. Agents 0, 1 and 2 stand
-- at (12, 8), (12, 10) and (12, 12).
local mine = memory { prey = nobody, thing = nobody, spot = nobody, copy = nobody, seen_at = 0 }
local north = best("people", other.y)
local pair = neighbours("people"):within(2.5)

return machine { name = "somebody", version = 1, start = "Choose", defaults = { perception = 30 }, states = {
  Choose = { steer = hold,
    { to = "Check", when = after(0.1) & ~exists(mine.prey) & ~sees(mine.prey) & mine.prey.x:is(0),
      set = { prey = north, thing = nearest "ball", spot = "post", seen_at = north.y } } },
  Check = { steer = hold,
    { to = "Copy", when = exists(mine.prey) & sees(mine.prey) & same(mine.prey, north) & ~same(mine.prey, mine.thing)
        & mine.prey.y:is(mine.seen_at) & mine.seen_at:at_least(10) & distance(mine.prey):below(4.5)
        & mine.thing.x:below(4) & distance(mine.spot):above(6) & mine.spot.x:is(5) & pair:at_least(1)
        & ~sees(mine.prey:within(0.5)) & ~same(mine.copy, mine.prey),
      set = { copy = mine.prey } } },
  Copy = { steer = hold,
    { to = "Walk", when = same(mine.copy, mine.prey) & same(mine.prey, mine.prey), set = { copy = nobody } } },
  Walk = { steer = field(mine.spot), face = mine.prey, -- memory that holds a place is one
    { to = "Pass", when = inside("yard") & near(mine.spot, 1.5) & ~exists(mine.copy) } },
  Pass = { steer = hold },
} }
