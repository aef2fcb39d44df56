-- expects: load-error no patterns
("x"):rep(1000):gsub(".*", function(s) return s .. s end)
