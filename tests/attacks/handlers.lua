-- expects: load-error unknown word 'xpcall'
xpcall(error, function() while true do end end)
