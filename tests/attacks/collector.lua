-- expects: load-error unknown word 'collectgarbage'
collectgarbage("stop")
