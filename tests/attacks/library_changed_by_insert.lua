-- expects: load-error library
table.insert(math, function() end)
