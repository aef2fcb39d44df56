-- expects: load-error
string.upper = nil
