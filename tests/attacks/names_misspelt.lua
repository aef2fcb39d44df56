-- expects: load-error
-- Each unknown word is compared with the whole vocabulary.
while true do local _ = nosuchword end
