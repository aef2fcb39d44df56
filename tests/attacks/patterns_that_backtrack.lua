-- expects: load-error no patterns
local s = ("a"):rep(40)
s:find(("a?"):rep(40) .. ("a"):rep(40))
s:match(("(.-)*"):rep(20) .. "b")
