-- expects: load-error unknown
local _ = now["\27[2J\27]0;title\7"]
