-- expects: load-error
for _ in pairs({ 1 }), nil, nil, {} do end
