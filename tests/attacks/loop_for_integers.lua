-- expects: load-error too long
for i = math.mininteger, math.maxinteger do end
