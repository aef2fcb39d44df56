-- expects: load-error too long
-- Adding one changes nothing any more.
for x = 2.0 ^ 53, 2.0 ^ 54 do end
