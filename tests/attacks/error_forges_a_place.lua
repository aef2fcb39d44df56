-- expects: load-error forged
error("b99:12: forged", 0)
