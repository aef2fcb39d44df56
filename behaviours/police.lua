-- One of a line of police: stands in a row on a line, and at each signal "advance" moves on to the next line, pushing
-- infected people before it. A group gives its lines: set: {first: line_1, second: line_2, last: line_3}.
return machine {
  name = "police", version = 1, start = "Post",
  own = { first = "line_1", second = "line_2", last = "line_3" },
  defaults = { speed = 1, mass = 95, perception = 5, push = 400, brace = 800, yield = 0.1 },

  states = {
    Post = { steer = formation(own.first, 0.5), face = own.last, ignore = "infected", push_only = "infected",
      { to = "Second", when = heard "advance" } },

    Second = { steer = formation(own.second, 0.5), face = own.last, ignore = "infected", push_only = "infected",
      { to = "Last",   when = heard "advance" & after(1) } },

    Last = { steer = formation(own.last, 0.5), face = own.last, ignore = "infected", push_only = "infected",
      { to = "Guard",  when = stuck(20) } },

    Guard = { steer = hold, face = own.last, push_only = "infected" },
  },
}
