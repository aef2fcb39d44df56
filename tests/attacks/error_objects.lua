-- expects: load-error needs a text
error({ code = 1 })
