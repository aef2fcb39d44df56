-- expects: load-error too long
-- The worst case of a plain search, again and again.
local s, what = ("a"):rep(2 ^ 19), ("a"):rep(2 ^ 10) .. "b"
while true do s:find(what) end
