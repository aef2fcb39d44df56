-- expects: load-error needs a text
error()
