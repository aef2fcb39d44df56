-- Messages and reactions: agents 0, 1 and 2 count pings of the others in every state, and answer a question while they
-- are in another state than the one that handles it.
local mine = memory { pings = 0, ticks = 0, answers = 0, asked_by = nobody, shown = nobody, sum = 0, late = 0 }
local ping, question, answer = told "ping", told "question", told "answer"
local everybody = neighbours("people"):within(10)

return machine { name = "messages", version = 1, start = "Ask", defaults = { perception = 20 }, states = {
  Ask = { steer = hold, tell = { everybody, "question", number = now.y, thing = nearest "ball", soon = ~after(1) },
    { when = ping, set = { pings = mine.pings + ping.weight } },
    { every = 0.5, set = { ticks = mine.ticks + 1 }, tell = { everybody, "ping", weight = 1 } },
    { every = 0.5, when = ~exists(mine.shown), set = { late = mine.late + 1 } },
    -- nothing is asked here: questions wait
    { to = "Answer", when = after(2) } },
  Answer = { steer = hold,
    { when = question & exists(question.thing) & exists(question.sender) & question.soon:is(1),
      set = { asked_by = question.sender, shown = question.thing, sum = mine.sum + question.number },
      tell = { question.sender, "answer", twice = 2 * question.number } },
    { when = answer & ~same(answer.sender, mine.shown), set = { answers = mine.answers + answer.twice } },
    { to = "Check", when = after(1) } },
  Check = { steer = hold,
    -- 4 steps of 0.5 s, with two others (agent 2 is 2 m from agent 1 and 4 m from agent 0); the last pings wait.
    { to = "Pass", when = mine.pings:at_least(6) & mine.ticks:is(4) & mine.late:is(4) & ~question & ~answer
        & same(mine.shown, nearest "ball") & (mine.sum + now.y):at_least(29) & (mine.sum + now.y):at_most(31)
        & (mine.answers - 4 * now.y):at_least(-1) & (mine.answers - 4 * now.y):at_most(1) & exists(mine.asked_by) } },
  Pass = { steer = hold },
} }
