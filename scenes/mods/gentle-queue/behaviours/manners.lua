-- What the gentle take into account, for patches and behaviours of other mods too: require "gentle-queue:manners".
local manners = {}

-- Whether there is room about a place: fewer than `most` people per square metre.
function manners.has_room(place, most)
  return ~density(place):above(most)
end

-- Who is squeezed by more than this, N, gives way.
manners.squeezed = pushed:above(200)

return manners
