-- pupil.lua, teacher.lua and warden.lua: classes go out, are counted, and who is missing is looked for.
test("every class is complete at the end, one of them after a search", function()
  local s = scene "drill.yaml"
  s:run(5)
  for _, one in ipairs(s:agents "class_1") do equal(one.state, "Sit") end
  s:reaches("Search", { agents = "warden", within = 70 })
  s:run(60)
  for group, missed in pairs { teacher_1 = 0, teacher_2 = 2, teacher_3 = 0 } do
    local teacher = s:agents(group)[1]
    equal(teacher.state, "Done")
    equal(teacher.present, 12)
    equal(teacher.missed, missed)
  end
  local warden = s:agents("warden")[1]
  equal(warden.classes, 3)
  equal(warden.found, 2)
  for _, one in ipairs(s:agents "washing") do equal(one.told_by, warden.id) end
end)

test("without the bell nobody moves", function()
  local s = scene("drill.yaml", { set = { ["events.0.signal"] = "nothing" } })
  s:run(20)
  for _, group in ipairs { "class_1", "class_2", "class_3" } do
    for _, one in ipairs(s:agents(group)) do equal(one.state, "Sit") end
  end
end)
