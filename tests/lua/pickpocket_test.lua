-- pickpocket.lua, stroller.lua and constable.lua: who is robbed says who did it, and that one is held.
local function square(options)
  return scene("pickpocket.yaml", options)
end

test("thieves take purses, and are arrested", function()
  local s, stolen = square(), 0
  for _ = 1, 60 do
    s:run(1)
    for _, one in ipairs(s:agents "strollers") do
      if one.purse == 0 then stolen = stolen + 1 end
    end
  end
  local arrests = 0
  for _, one in ipairs(s:agents "constables") do arrests = arrests + one.arrests end
  truthy(stolen > 0, "somebody is robbed")
  truthy(arrests > 0, "somebody is arrested")
  equal(#s:agents "thieves", 3 - arrests)
end)

test("nobody is arrested of whom nobody tells", function()
  local s = square { set = { ["groups.strollers.set.perception"] = 0 } }
  s:run(60)
  equal(#s:agents "thieves", 3)
  for _, one in ipairs(s:agents "constables") do equal(one.arrests, 0) end
end)

test("who was robbed knows by whom", function()
  local s = square()
  s:reaches("Call", { agents = "strollers", within = 40, any = true })
  local thieves, known = {}, 0
  for _, one in ipairs(s:agents "thieves") do thieves[one.id] = true end
  for _, one in ipairs(s:agents "strollers") do
    if one.state == "Call" then
      known = known + 1
      truthy(thieves[one.thief], "the thief is one of the thieves")
      equal(one.purse, 0)
    end
  end
  truthy(known > 0)
end)
