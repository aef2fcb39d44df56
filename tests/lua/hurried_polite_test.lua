-- hurried.lua and polite.lua: the one pushes and is fast, the other moves nobody (the paper, 4.1).

-- How far whoever was moved most is from where it stood.
local function moved(before, after)
  local most = 0
  for i, a in ipairs(after) do
    most = math.max(most, math.abs(a.x - before[i].x) + math.abs(a.y - before[i].y))
  end
  return most
end

test("the hurried one is faster and moves others more", function()
  for seed = 1, 2 do
    local s = scene("hurried-polite.yaml", { seed = seed })
    local north, south = s:agents("north_crowd"), s:agents("south_crowd")
    local fast = s:reaches("Arrived", { agents = "hurried", within = 30 })
    local slow = s:reaches("Arrived", { agents = "polite", within = 60 })
    truthy(fast < slow - 1, fast .. " s and " .. slow .. " s")
    local pushed, left = moved(north, s:agents("north_crowd")), moved(south, s:agents("south_crowd"))
    truthy(pushed > 1.5 * left, pushed .. " m and " .. left .. " m")
  end
end)
