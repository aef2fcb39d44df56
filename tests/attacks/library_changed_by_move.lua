-- expects: load-error library
table.move({ 1 }, 1, 1, 1, string)
