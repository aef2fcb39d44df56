-- expects: load-error
return machine { name = "m\27[2J", start = "\27[2J", states = { ["\27[2J"] = { steer = hold } } }
