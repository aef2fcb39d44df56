-- expects: load-error
for i = 1, 1e9 do local _ = own["name" .. i] end
