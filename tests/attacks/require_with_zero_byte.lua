-- expects: load-error
require "honest\0/../../etc/passwd"
