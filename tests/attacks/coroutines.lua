-- expects: load-error unknown word 'coroutine'
coroutine.wrap(function() while true do coroutine.yield() end end)()
