-- expects: load-error
for i = 1, 1e6 do require("missing" .. i) end
