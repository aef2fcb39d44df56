#!/bin/bash
# What it costs that people know each other: processor time of 10,000 people of whom each holds somebody, looks at whom
# it holds in every step, and tells them something once a second, less that of the same people without it, as a share of
# an agent-step of the Tawaf. The runs take turns. Prints the least and the median of ROUNDS; nothing passes or fails.
set -eu
cd "$(dirname "$0")/../.."
B=${B:-build/release}
ROUNDS=${ROUNDS:-5}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
behaviour() { # NAME MEMORY, then items of the state from standard input
    {
        echo "local mine = memory { n = 0$2 }"
        echo "return machine { name = \"$1\", version = 1, start = \"Walk\","
        echo "defaults = { speed = 1, perception = 5, neighbours = 10 }, states = { Walk = { steer = wander(),"
        cat
        echo '} } }'
    } >"$work/$1.lua"
    cat >"$work/$1.yaml" <<SCENE
jostle: 1
places: {floor: {polygon: [[0, 0], [150, 0], [150, 150], [0, 150]]}}
groups: {people: {behaviour: $1.lua, count: 10000, fill: grid, spacing: 1.5, in: floor}}
SCENE
}
behaviour plain "" </dev/null
behaviour holders ", friend = nobody" <<'END'
{ when = ~exists(mine.friend), set = { friend = nearest "anyone" } },
{ when = sees(mine.friend) & mine.friend.speed:above(100), set = { n = 0 } },
{ every = 1, tell = { mine.friend, "hello", at = now.x } },
{ when = told "hello", set = { n = told("hello").at } },
END
TIMEFORMAT=%U
spent() { # SCENE STEPS...: processor time, s, of STEPS steps, less that of loading
    local scene=$1 steps=$2 long short
    shift 2
    long=$( { time "$B/jostle" run "$scene" --steps $((steps + 20)) --threads 1 --quiet "$@" >/dev/null 2>&1; } 2>&1)
    short=$( { time "$B/jostle" run "$scene" --steps 20 --threads 1 --quiet "$@" >/dev/null 2>&1; } 2>&1)
    awk -v a="$long" -v b="$short" 'BEGIN {print a - b}'
}
for ((round = 0; round < ROUNDS; round++)); do
    plain=$(spent "$work/plain.yaml" 200)
    holders=$(spent "$work/holders.yaml" 200)
    tawaf=$(spent scenes/tawaf.yaml 60)
    awk -v p="$plain" -v h="$holders" -v t="$tawaf" 'BEGIN {
        each = t / 60 / 35000; print (h - p) / 200 / 10000 / each, p / 200 / 10000 / each}'
done | sort -n | awk '{row[NR] = $0} END {
    print "holding and telling, in agent-steps of the Tawaf (and all else of these people)"
    print "least", row[1]; print "median", row[int((NR + 1) / 2)]}'
