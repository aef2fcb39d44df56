-- How people slow down among others and push, as expressions that behaviours share.
local crowd = {}

-- Time kept to whoever walks ahead, s, by those who are not eager: what `time_gap` is to all who walk by the walking
-- law (core/walking.md). A group's `haste` (calm, normal, keen) and the crowd itself shorten it.
crowd.time_gap = 1.06

-- Speed that leaves 0.88 s to whoever walks ahead, and does not close up where five stand on a square metre, m/s;
-- never quite nothing. It gives the speeds and densities of people in single file (Seyfried and others 2005) and in
-- wide corridors.
crowd.by_headway = clamp(min(headway / 0.88, 0.5 * (5 - density_here)), 0.05, own.speed)

-- How far walkers look ahead, s: those who crawl in a crowd mind only what is next to them.
crowd.foresight = clamp(2 * now.speed, 0.5, 2)

-- In front of a door people close up, m/s, ...
crowd.at_door = clamp(headway / 0.25, 0.05, own.speed)

-- ... and who is slow there leans on those ahead, as does who is held up elsewhere, N.
crowd.nudge = 23 * max(now.speed, own.speed)
crowd.slow_at_door = now.speed:below(0.3 * own.speed)
crowd.held_up = stuck(5)

-- Speed that falls with density from 1 person per square metre on, to 60 % at 8.
crowd.by_density = own.speed * (1 - 0.4 * clamp((density_here - 1) / 7, 0, 1))

-- Speed of free walkers at a density, after Weidmann: 1.34 m/s alone, a shuffle at 5.4 per square metre.
crowd.weidmann = own.speed * clamp(1 - (density_here - 0.3) / 5.1, 0.1, 1)

return crowd
