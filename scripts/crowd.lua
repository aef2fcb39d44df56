-- How people slow down among others and push, as expressions that behaviours share.
local crowd = {}

-- Speed that leaves 0.95 s to whoever walks ahead, never below a fifth of the wanted speed.
crowd.by_headway = clamp(headway / 0.95, 0.2 * own.speed, own.speed)

-- Who is held up leans on those ahead: a push of so many newtons, in reach, and only while slow.
crowd.nudge = 20 * max(now.speed, own.speed)
crowd.held_up = now.speed:below(0.3 * own.speed)

-- Speed that falls with density from 1 person per square metre on, to 60 % at 8.
crowd.by_density = own.speed * (1 - 0.4 * clamp((density_here - 1) / 7, 0, 1))

-- Speed of free walkers at a density, after Weidmann: 1.34 m/s alone, a shuffle at 5.4 per square metre.
crowd.weidmann = own.speed * clamp(1 - (density_here - 0.3) / 5.1, 0.1, 1)

return crowd
