-- expects: load-error not a plain name
require "a/../../b"
