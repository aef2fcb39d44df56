-- expects: load-error not a plain name
require "/etc/passwd"
