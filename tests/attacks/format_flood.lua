-- expects: load-error too long
while true do local _ = string.format("%99.99f %99.99f %99.99f", 1e308, 1e308, 1e308) end
