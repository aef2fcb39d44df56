-- Conditions for gentle people, also for patches and behaviours of other mods: require "gentle-queue:manners".
local manners = {}

-- Whether there is room around a place: fewer than `most` people per square metre.
function manners.has_room(place, most)
  return ~density(place):above(most)
end

-- Whether the net force on an agent is above 200 N: it then gives way.
manners.squeezed = pushed:above(200)

return manners
