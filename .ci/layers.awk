# Which folder of core includes which: only its own or a strictly lower floor, and no file includes
# itself in a circle. Prints each breach.
BEGIN {
    split("include 0 base 0 task 1 geom 1 agents 1 nav 2 force 2 body 2 machine 2 world 3 " \
          "scene 4 lua 4 record 4 view 4 host 5 cli 6", words, " ")
    for (i = 1; (i + 1) in words; i += 2) floor_of[words[i]] = words[i + 1]
}
{ sub(/\r$/, "") }
/^#include "/ {
    split(FILENAME, parts, "/")
    mine = parts[2]
    target = $2
    gsub(/"/, "", target)
    if (target == "jostle.h") next
    n = split(target, bits, "/")
    other = bits[1]
    if (n < 2 || !(other in floor_of)) { print FILENAME ": includes " target ", of no folder of core"; next }
    if (!(mine in floor_of)) { print FILENAME ": its folder has no floor"; next }
    if (mine != other && floor_of[other] >= floor_of[mine])
        print FILENAME ": " mine " (floor " floor_of[mine] ") includes " target " (floor " floor_of[other] ")"
    if (mine == "cli" && other != "cli") print FILENAME ": cli calls jostle.h alone, not " target
    file = FILENAME
    sub(/^core\//, "", file)
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
