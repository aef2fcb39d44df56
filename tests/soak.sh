#!/bin/bash
# A long run with all that goes on beside one: the Tawaf with people who come and leave, behaviours that are saved again
# and again, a page that somebody looks at, the recorder, the input log and checkpoints. For JOSTLE_SOAK seconds, in real
# time, with PEOPLE pilgrims. Then 1,000 reloads and 10,000 page connects (RELOADS, CONNECTS). Prints "ok NAME" or "not ok NAME",
# with the figures.
cd "$(dirname "$0")/.." || exit 1
. tests/scenes/lib.sh
seconds=${JOSTLE_SOAK:-3600}
people=${PEOPLE:-2000}
sets="--set groups.pilgrims.count=$people --set sources.0.keep=$people"
program=$(case $JOSTLE in /*) echo "$JOSTLE" ;; *) echo "$PWD/$JOSTLE" ;; esac)
pid=
trap '[ -z "$pid" ] || kill -KILL $pid 2>/dev/null; rm -rf "$work"' EXIT

plant() { # NAME: a copy of the scenes and behaviours, to be edited
    mkdir -p "$work/$1"
    cp -r scenes behaviours "$work/$1/"
}
begin() { # NAME ARGS...: a run in the tree of that name, whose number is left in pid
    local tree=$work/$1; shift
    timeout -s KILL $((seconds + 3600)) "$program" run "$@" >"$tree/said" 2>&1 </dev/null & pid=$!
    pid=$(until pgrep -P $! ; do sleep 0.05; done)
}
live() { grep -c ' is live' "$work/$1/said"; }
save() { # NAME FILE: saves a behaviour with another comment, and waits until it is live
    local before waited=0; before=$(live "$1")
    until [ "$(live "$1")" -gt "$before" ]; do
        kill -0 $pid 2>/dev/null || return 1
        if [ $((waited++ % 100)) = 0 ]; then { cat "behaviours/$2"; echo "-- $before $waited"; } >"$work/$1/behaviours/$2"; fi
        sleep 0.02
    done
}
sample() { # NAME: a line of step, CPU in 1/100 s, memory in KB, open files
    echo "$(grep -a -o '^[0-9]* files' "$work/$1/log" | tail -1 | cut -d' ' -f1)" \
        "$(awk '{print $14 + $15}' /proc/$pid/stat)" "$(awk '/^VmRSS/ {print $2}' /proc/$pid/status)" \
        "$(ls /proc/$pid/fd | wc -l)" >>"$work/$1/samples"
}
# The last quarter against the second one: memory, and processor time of a step.
judge() { # NAME: of the samples
    awk -v name="$1" '{step[NR] = $1; cpu[NR] = $2; rss[NR] = $3; fds[NR] = $4}
        function mean(v, from, to,   i, sum) {for (i = from; i <= to; i++) sum += v[i]; return sum / (to - from + 1)}
        function cost(from, to) {return 10 * (cpu[to] - cpu[from]) / (step[to] - step[from])}
        END {
            q = int(NR / 4)
            if (q < 3) {print "not ok " name ": only " NR " samples"; exit}
            early = mean(rss, q + 1, 2 * q); late = mean(rss, NR - q + 1, NR)
            printf "%s %s: memory flat: %.1f MB, then %.1f MB\n", late < 1.05 * early + 4096 ? "ok" : "not ok", name, early / 1024, late / 1024
            a = cost(q + 1, 2 * q); b = cost(NR - q + 1, NR)
            printf "%s %s: processor time of a step: %.3f ms, then %.3f ms\n", b < 1.3 * a ? "ok" : "not ok", name, a, b
            printf "%s %s: %d files open, then %d\n", fds[NR] <= fds[q + 1] ? "ok" : "not ok", name, fds[q + 1], fds[NR]
        }' "$work/$1/samples"
}
address() { # NAME: of its page
    until grep -o 'http://[^ ]*' "$work/$1/said"; do sleep 0.1; done
}

# ---- all at once, in real time ----
plant all
begin all "$work/all/scenes/tawaf.yaml" $sets --threads 1 --view --view-wait 0 --for 1e6 --record "$work/all/r.sqlite" --record-every 5 \
    --log-input "$work/all/log" --checkpoint 60 --checkpoint-dir "$work/all/ck" --summary "$work/all/summary"
page=$(address all)
python3 tests/page/look.py "$page" >"$work/seen" 2>&1 &
until=$((SECONDS + seconds))
while [ $SECONDS -lt $until ] && save all tawaf.lua; do
    sample all
    sleep "${PAUSE:-1}"
done
kill -TERM $pid 2>/dev/null; wait; pid=
judge all
[ "$(cat "$work/seen")" -gt $((2 * seconds)) ] # it was open to the end
verdict "all: the page showed $(cat "$work/seen") frames" $?
[ "$(sqlite3 "$work/all/r.sqlite" 'PRAGMA integrity_check')" = ok ]
verdict "all: the recording is whole" $?
# Who came in at the arrivals has gone round seven times, as the recording has it, when they leave.
sqlite3 "$work/all/r.sqlite" "SELECT t.id, t.pos_x, t.pos_y, s.state FROM trajectory_data t JOIN jostle_state s ON s.number = t.state
    WHERE t.id >= $people ORDER BY t.id, t.frame" | awk -F'|' -v pi=3.14159265 '
    $1 != id {id = $1; turned = 0; begun = left = 0}
    left {next}
    {angle = atan2($3, $2); if (begun) {d = angle - before; turned += d > pi ? d - 2 * pi : d < -pi ? d + 2 * pi : d}}
    $4 != "Enter" {begun = 1}
    $4 == "Leave" {left = 1; people++; turns = turned / (2 * pi); sum += turns; bad += turns < 6.8 || turns > 7.2}
    {before = angle}
    END {printf "%s all: %d people left after %.2f circuits in the mean, %d of them after more or less than seven\n", people && !bad ? "ok" : "not ok", people, people ? sum / people : 0, bad}'
steps=$(figure steps <"$work/all/summary")
whole=$(figure hash <"$work/all/summary")
"$program" resume "$work/all/ck" --quiet --for "$(awk -v n="$steps" 'BEGIN {print n * 0.05}')" --summary "$work/all/resumed"
same_hash "all: its newest checkpoint goes on to the state at its end" "$whole" "$(figure hash <"$work/all/resumed")"
same_hash "all: after $steps steps and $(live all) reloads the state is that of a run with nothing beside it" \
    "$whole" "$(hash_of "$program" scenes/tawaf.yaml $sets --steps "$steps")"
echo "# all: $(sed -n 's/^  "\(spawned\|removed\|people_lost\)": \([0-9]*\),/\2 \1/p' "$work/all/summary" | tr '\n' ' ')"

# ---- many reloads and connects ----
plant small
begin small "$work/small/scenes/running-through.yaml" --view --for 1e6 --log-input "$work/small/log" --summary "$work/small/summary"
page=$(address small)
python3 tests/page/look.py "$page" 100 >/dev/null
save small runner.lua; sample small
python3 tests/page/look.py "$page" "${CONNECTS:-10000}" >"$work/seen"
verdict "$(cat "$work/seen") page connects" $?
for _ in $(seq "${RELOADS:-1000}"); do save small runner.lua || break; done
[ "$(live small)" -gt "${RELOADS:-1000}" ]
verdict "$(live small) reloads" $?
sleep 1; sample small
awk 'NR == 1 {files = $4; memory = $3} END {printf "%s %d files open before them, %d after; memory %.1f MB, then %.1f MB\n", $4 <= files ? "ok" : "not ok", files, $4, memory / 1024, $3 / 1024}' "$work/small/samples"
kill -TERM $pid; wait; pid=
exit 0
