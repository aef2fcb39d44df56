-- expects: load-error 100,000
table.move({}, 1, math.maxinteger, 2)
