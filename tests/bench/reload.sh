#!/bin/bash
# How long an edit takes to go live, and how long it holds the step up: the Tawaf with 35,000 people
# and 100 edits (a condition, a duration, two distributions, a value that is new), each of which also
# takes back the one before. Prints percentiles; nothing passes or fails. EDITS, and ARGS for the run
# (as --threads 2), may be set.
set -u
cd "$(dirname "$0")/../.."
B=${B:-build/release}
EDITS=${EDITS:-100}
work=$(mktemp -d)
pid=
trap '[ -z "$pid" ] || kill -KILL $pid; rm -rf "$work"' EXIT
mkdir "$work/scenes" "$work/behaviours"
cp scenes/tawaf.yaml "$work/scenes/"; cp behaviours/*.lua "$work/behaviours/"
file=$work/behaviours/tawaf.lua

"$B/jostle" run "$work/scenes/tawaf.yaml" --steps 900000000 --watch --quiet --no-mods ${ARGS:-} >"$work/said" 2>&1 </dev/null &
pid=$!
until [ "$(ls /proc/$pid/task 2>/dev/null | wc -l)" -ge 2 ] || ! kill -0 $pid; do sleep 0.05; done
sleep 3
edit() { # NUMBER: what is changed in the file, of which the original is on stdin
    case $(($1 % 4)) in
    0) sed "s/after(60)/after($((60 + $1)))/" ;;
    1) sed "s/lasts = 3/lasts = 3.$1/" ;;
    2) sed "s/normal(1.0, 0.15, 0.5, 2.0)/normal(1.$1, 0.15, 0.5, 2.0)/; s/perception = 3/perception = 3.$1/" ;;
    3) sed "s/, push = shove/, push = shove, mass = uniform(60, 9$1)/" ;;
    esac
}
for i in $(seq "$EDITS"); do
    edit "$i" <behaviours/tawaf.lua >"$file"
    until grep -q "version 1 (reload $i) is live" "$work/said"; do
        kill -0 $pid 2>/dev/null && ! grep -q 'keeps running' "$work/said" || { tail "$work/said"; exit 1; }
        sleep 0.01
    done
    sleep 0.0$((RANDOM % 90 + 10)) # somewhere in the next step
done
kill -INT $pid; wait $pid; pid=
percentiles() { # NAME UNIT: of the numbers on stdin
    sort -n | awk -v name="$1" -v unit="$2" '{v[NR] = $1}
        function at(p) {return v[int(p * (NR - 1) + 1.5)]}
        END {printf "%-36s p50 %7.2f  p95 %7.2f  most %7.2f %s (%d edits)\n", name, at(0.5), at(0.95), v[NR], unit, NR}'
}
figures() { sed -n "s/.*saved \([0-9.]*\) ms ago, swapped in \([0-9.]*\) ms.*/\\$1/p" "$work/said"; }
figures 1 | percentiles "save to live" ms
figures 2 | percentiles "the step is held up by the swap" ms
