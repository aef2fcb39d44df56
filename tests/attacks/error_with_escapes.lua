-- expects: load-error ?[2J
-- What it says must not command the terminal.
error("\27[2J\27]0;title\7\r\8")
