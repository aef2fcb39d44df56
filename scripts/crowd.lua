-- How people slow down among others and push, as expressions that behaviours share.
local crowd = {}

-- Speed that leaves 0.88 s to whoever walks ahead, never quite nothing.
crowd.by_headway = clamp(headway / 0.88, 0.05, own.speed)

-- At a door people squeeze through: they come on even without a gap.
crowd.at_door = clamp(headway / 0.35, 0.05, own.speed)

-- Who is held up leans on those ahead, N.
crowd.nudge = 22 * max(now.speed, own.speed)
crowd.held_up = stuck(2)
crowd.held_up_at_door = now.speed:below(0.3 * own.speed)

-- Speed that falls with density from 1 person per square metre on, to 60 % at 8.
crowd.by_density = own.speed * (1 - 0.4 * clamp((density_here - 1) / 7, 0, 1))

-- Speed of free walkers at a density, after Weidmann: 1.34 m/s alone, a shuffle at 5.4 per square metre.
crowd.weidmann = own.speed * clamp(1 - (density_here - 0.3) / 5.1, 0.1, 1)

return crowd
