-- Names of `me` and of views: memory comes before fields of the same name, whatever machine the other has.
local ASKER = [[
  memory { x = 7, state = 8, team = false, same = 0, other = 0, missing = false, wrong = 0,
    a_name_that_is_longer_than_the_texts_that_Lua_keeps_once = 5 }
  local drawn = { perception = 50, neighbours = 16, speed = 1.25 }
  return machine { name = "asker", start = "Ask", defaults = drawn, states = {
    Ask = { steer = hold, { to = "Asked", when = function(me)
      local key = "a_name_that_is_longer_than" .. "_the_texts_that_Lua_keeps_once"
      if me.x ~= 7 or me.state ~= 8 or me.team ~= false then me.wrong = 1 end
      if me.a_name_that_is_longer_than_the_texts_that_Lua_keeps_once ~= 5 or me[key] ~= 5 then me.wrong = 4 end
      for _, other in ipairs(me.neighbours) do
        if other.machine == "asker" then
          me.same = me.same + other.x + other.a_name_that_is_longer_than_the_texts_that_Lua_keeps_once + other.speed
          if other.state ~= "Ask" or other.neighbours ~= 16 then me.wrong = 2 end
        else
          me.other = me.other + other.points
          me.missing = other.same == nil and other.a_name_that_is_longer_than_the_texts_that_Lua_keeps_once == nil
          if other.x < 2 or other.vx ~= 0 or other.state ~= "Wait" then me.wrong = 3 end
        end
      end
      return true
    end } },
    Asked = { steer = hold } } }]]
local OTHER = [[
  memory { a = 0, points = 30 }
  return machine { name = "other", start = "Wait", states = { Wait = { steer = hold } } }]]

test("memory comes first, of each machine its own", function()
  local s = scene { groups = {
    askers = { behaviour = ASKER, at = { { 0, 0 }, { 1, 0 } } },
    others = { behaviour = OTHER, at = { { 2, 0 }, { 3, 1 } } } } }
  s:run(0.2)
  for _, asker in ipairs(s:agents("askers")) do
    equal(asker.wrong, 0)
    equal(asker.same, 7 + 5 + 1.25)
    equal(asker.other, 60)
    truthy(asker.missing)
  end
end)

test("all views of a call are valid until its end, however many", function()
  local at = {}
  for i = 1, 50 do at[i] = { i % 10, i // 10 } end
  local s = scene { groups = { people = { behaviour = [[
    memory { good = false }
    return machine { name = "m", start = "A", defaults = { perception = 50 }, states = {
      A = { steer = hold, { to = "B", when = function(me)
        local first, second, third, seen = me.neighbours, me.neighbours, me.neighbours, {}
        local good = #first == 49
        for i = 1, #first do
          good = good and first[i].id == second[i].id and first[i].id == third[i].id and not seen[first[i].id]
          seen[first[i].id] = true
        end
        me.good = good
        return true
      end } }, B = { steer = hold } } }]], at = at } } }
  s:run(0.2)
  for _, agent in ipairs(s:agents("people")) do truthy(agent.good) end
end)
