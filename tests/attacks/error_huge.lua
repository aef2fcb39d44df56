-- expects: load-error boom
error("boom" .. ("!"):rep(2 ^ 19))
