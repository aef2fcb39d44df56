-- expects: load-error '_ENV' cannot be used
_ENV = {}
