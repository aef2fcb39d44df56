-- How people walk among others and press, as values that behaviours share.
local crowd = {}

-- Time kept to whoever walks ahead, s, by those who are not eager: what `time_gap` is to all who walk by the walking
-- law (core/walking.md). A group's `haste` (calm, normal, keen) and the crowd itself shorten it.
crowd.time_gap = 0.922

-- Who is eager and hardly gets on leans on those ahead, N; who stands where others walk does so after 5 s.
crowd.nudge = 32 * eagerness * own.speed
crowd.held_up = now.speed:below(0.3 * own.speed) & eagerness:above(0.4) | stuck(5)

-- Free way ahead as those who do not walk by the law judge it: 0.88 s to whoever walks ahead, m/s; never quite nothing.
crowd.by_headway = clamp(min(headway / 0.88, 0.5 * (5 - density_here)), 0.05, own.speed)

return crowd
