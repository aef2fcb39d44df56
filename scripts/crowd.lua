-- Values that behaviours share: how people walk among others, and how they press.
local crowd = {}

-- Time gap to the person ahead, s, of people who are not eager: the `time_gap` of all behaviours that walk by the
-- walking law (core/walking.md). A group's `haste` (calm, normal, keen) and the crowd itself shorten it.
crowd.time_gap = 0.922

-- Push, N, of an eager agent that hardly gets on against the agents ahead; one that stands where others walk pushes
-- after 5 s.
crowd.nudge = 32 * eagerness * own.speed
crowd.held_up = now.speed:below(0.3 * own.speed) & eagerness:above(0.4) | stuck(5)

-- Speed, m/s, of agents that walk by ORCA: free distance ahead divided by 0.88 s, and never quite 0.
crowd.by_headway = clamp(min(headway / 0.88, 0.5 * (5 - density_here)), 0.05, own.speed)

return crowd
