# Checks the #include lines of core: a file may include its own folder or a strictly lower floor, and includes have no
# cycle. Prints each breach. Needs floors.awk before it.
BEGIN { floors(floor_of) }
{ sub(/\r$/, "") }
# Returns the folder of a path below core/.
function room_of(path) { sub(/\/[^\/]*$/, "", path); return path }
function may_include(mine, other,    a, b) {
    if (mine == other) return 1
    split(mine, a, "/"); split(other, b, "/")
    if (a[1] == b[1]) return floor_of[other] < floor_of[mine]
    return int(floor_of[other]) < int(floor_of[mine])
}
/^#include "/ {
    file = FILENAME
    sub(/^core\//, "", file)
    mine = room_of(file)
    target = $2
    gsub(/"/, "", target)
    if (target ~ /^jostle(_[a-z]+)?\.h$/) next
    other = room_of(target)
    if (other == target || !(other in floor_of)) { print FILENAME ": includes " target ", of no folder of core"; next }
    if (!(mine in floor_of)) { print FILENAME ": its folder has no floor"; next }
    if (!may_include(mine, other))
        print FILENAME ": " mine " (floor " floor_of[mine] ") includes " target " (floor " floor_of[other] ")"
    if (mine ~ /^cli/ && other !~ /^cli/ && other != "base" && other != "base/format") print FILENAME ": cli calls the public headers and base alone, not " target
    edges[file] = edges[file] " " target
}
function visit(file,    list, i, n) {
    if (state[file] == 2) return
    if (state[file] == 1) { print file ": includes itself in a circle"; return }
    state[file] = 1
    n = split(edges[file], list, " ")
    for (i = 1; i <= n; i++) visit(list[i])
    state[file] = 2
}
END { for (file in edges) visit(file) }
