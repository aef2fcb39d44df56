-- expects: load-error
require {}
