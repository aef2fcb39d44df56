-- expects: load-error
("").upper = nil
