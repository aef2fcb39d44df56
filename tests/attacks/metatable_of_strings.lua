-- expects: load-error unknown word 'getmetatable'
getmetatable("").__index = nil
