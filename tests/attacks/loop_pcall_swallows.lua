-- expects: load-error too long
-- Each stop is caught and the loop begins again.
while true do pcall(function() while true do end end) end
