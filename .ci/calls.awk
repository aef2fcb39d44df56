# Checks the calls between files, read from `nm -A` of the object files: a file may call its own folder or a strictly
# lower floor (floors.awk), and the calls between files of a folder have no cycle. Use of another file's data counts as a
# call. Prints each breach. Needs floors.awk before it. The first input file lists tolerated pairs, one per line:
# "CALLER CALLED why", as paths below core/ without their endings.
BEGIN { floors(floor_of) }
FNR == NR {
    if ($0 !~ /^#/ && NF > 2) allowed[$1 " " $2] = 1
    next
}
{
    file = $1
    sub(/:.*$/, "", file)
    sub(/^.*\/core\//, "", file)
    sub(/\.o$/, "", file)
    kind = $(NF - 1); symbol = $NF
    if (symbol !~ /^(jox?_|_Z[0-9A-Z]*[0-9]jox_)/) next # statics, other libraries
    if (kind ~ /^[TDBRV]$/) { home[symbol] = file; files[file] = 1 }
    else if (kind == "U") wants[file] = wants[file] " " symbol
}
function room_of(path) { sub(/\/[^\/]*$/, "", path); return path }
function may_call(mine, other,    a, b) {
    if (mine == other) return 1
    split(mine, a, "/"); split(other, b, "/")
    if (a[1] == b[1]) return floor_of[other] < floor_of[mine]
    return int(floor_of[other]) < int(floor_of[mine])
}
# Finds cycles as strongly connected components, by Tarjan's algorithm.
function visit(v,    list, n, i, w, members, size) {
    number[v] = low[v] = ++counter
    stack[++depth] = v; on_stack[v] = 1
    n = split(calls[v], list, " ")
    for (i = 1; i <= n; i++) {
        w = list[i]
        if (!number[w]) { visit(w); if (low[w] < low[v]) low[v] = low[w] }
        else if (on_stack[w] && number[w] < low[v]) low[v] = number[w]
    }
    if (low[v] != number[v]) return
    members = ""; size = 0
    do { w = stack[depth--]; on_stack[w] = 0; members = members " " w; size++ } while (w != v)
    if (size > 1) print "circle of calls:" members
}
END {
    for (file in wants) {
        n = split(wants[file], list, " ")
        for (i = 1; i <= n; i++) {
            other = home[list[i]]
            if (other == "" || other == file) continue
            pair = file " " other
            if (!may_call(room_of(file), room_of(other)) && !(pair in allowed))
                print file " calls " list[i] " of " other ", which is not below it"
            if (room_of(file) == room_of(other) && !(pair in allowed) && !(pair in known)) {
                known[pair] = 1
                calls[file] = calls[file] " " other
                through[pair] = list[i]
            }
        }
    }
    for (file in files) if (!number[file]) visit(file)
}
