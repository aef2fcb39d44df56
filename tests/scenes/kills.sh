# Kills runs (SIGKILL) at moments spread over their progress and at calls that change files, while they record, log, write
# checkpoints and a report, and while behaviours are saved. All files must be whole, and the runs resumable. JOSTLE_KILLS
# is the number of kills.
. tests/scenes/lib.sh
program=$(case $JOSTLE in /*) echo "$JOSTLE" ;; *) echo "$PWD/$JOSTLE" ;; esac)
kills=${JOSTLE_KILLS:-4}
kill_at=$PWD/tests/scenes/kill_at.py
calls=write,pwrite64,fsync,fdatasync,rename,ftruncate,openat,unlink
mkdir -p "$work/tree/scenes" "$work/tree/behaviours"
cp scenes/dodgeball.* "$work/tree/scenes/"
cp behaviours/dodgeball.lua "$work/tree/behaviours/"
cd "$work" || exit 1

# contents: prints everything of a recording. strangers: prints rows that another recording lacks up to the last frame.
contents() { sqlite3 "$1" 'PRAGMA integrity_check; SELECT * FROM trajectory_data ORDER BY frame, id; SELECT * FROM frame_data ORDER BY frame; SELECT * FROM jostle_body ORDER BY frame, id; SELECT * FROM metadata ORDER BY key' | sha256sum; }
strangers() {
    sqlite3 "$1" "ATTACH '$2' AS whole" 'PRAGMA main.integrity_check' \
        'SELECT count(*) FROM (SELECT * FROM main.trajectory_data EXCEPT SELECT * FROM whole.trajectory_data)' \
        'SELECT count(*) FROM (SELECT * FROM whole.trajectory_data WHERE frame <= (SELECT max(frame) FROM main.trajectory_data)
            EXCEPT SELECT * FROM main.trajectory_data)' 2>&1 | tr '\n' ' '
}
# arguments KIND: prints the arguments of a run, in a folder beside its tree.
arguments() {
    case $1 in
    reloads) echo tree/scenes/dodgeball.yaml --for 400 --record r.sqlite --record-every 0.5 --log-input log --checkpoint 12.8 --checkpoint-dir ck --data data --watch ;;
    report) echo tree/scenes/dodgeball.yaml --for 30 --record r.sqlite --record-every 0.1 --log-input log --checkpoint 6.4 --checkpoint-dir ck --report report --no-half-step ;;
    esac
}
begin() { # FOLDER
    rm -rf "$1"; mkdir "$1"
    cp -r tree "$1/tree"
}
# Complete runs for comparison, with their processor time (without the children that read the scene) and file calls.
for kind in reloads report; do
    begin "whole-$kind"
    (cd "whole-$kind" && python3 "$kill_at" 1e6 "$program" run $(arguments $kind) --quiet) >"$kind.took" 2>/dev/null
    [ $kind = report ] && [ "$kills" -lt 8 ] && continue
    begin counted
    (cd counted && strace -qq -f --seccomp-bpf -o ../trace -e trace=$calls "$program" run $(arguments $kind) --quiet) 2>/dev/null
    # of the thread with most calls, as strace counts per thread
    awk '{n[$1]++} END {for (p in n) if (n[p] > most) most = n[p]; print most}' trace >"$kind.calls"
done

saved() { # FOLDER: saves a behaviour repeatedly, with another comment each time
    local k
    for k in $(seq 1000); do
        sleep "0.0$((RANDOM % 9 + 1))"
        { cat tree/behaviours/dodgeball.lua; echo "-- $k"; } >"$1/new.lua" && mv "$1/new.lua" "$1/tree/behaviours/dodgeball.lua"
    done
}
good=0 resumed=0 ended=0 replayed=0 reloaded=0 writing=0 reporting=0
bad() { echo "  $*"; wrong=1; }
for k in $(seq 0 $((kills - 1))); do
    kind=reloads; [ $((k % 4)) = 3 ] && kind=report
    where=killed wrong=0 saver=
    begin $where
    [ $kind = report ] || { saved $where & saver=$!; }
    # Half of the kills come at a moment, half at a call; both are spread evenly over the run with random offsets.
    part=$(awk -v k="$k" -v n="$kills" -v r=$RANDOM 'BEGIN {printf "%.5f", (k + r / 32768) / n}')
    if [ $((k % 2)) = 0 ] || [ $((k % 8)) = 3 ]; then
        at=$(awk -v p="$part" -v t="$(cat $kind.took)" 'BEGIN {print p * t}')
        (cd $where && python3 "$kill_at" "$at" "$program" run $(arguments $kind) --quiet) >took 2>err
    else
        at=$(awk -v p="$part" -v n="$(cat $kind.calls)" 'BEGIN {print int(1 + p * n)}')
        (cd $where && timeout -s KILL 120 strace -qq -f --seccomp-bpf -o ../trace -e trace=$calls -e inject=$calls:signal=KILL:when="$at" "$program" run $(arguments $kind) --quiet) >took 2>err
    fi
    [ -z "$saver" ] || { kill $saver; wait $saver; } 2>/dev/null
    # ---- check the files that are left ----
    ls $where/ck/*.part >/dev/null 2>&1 && writing=$((writing + 1))
    [ -d $where/report ] && [ -n "$(ls $where/report)" ] && reporting=$((reporting + 1))
    grep -q '^[0-9]* files' $where/log 2>/dev/null && reloaded=$((reloaded + 1))
    if [ -s $where/r.sqlite ] && sqlite3 $where/r.sqlite 'SELECT frame FROM frame_data' 2>/dev/null | grep -q .; then
        left=$(strangers $where/r.sqlite whole-$kind/r.sqlite)
        [ "$left" = "ok 0 0 " ] || bad "kill $k: the recording has other frames: $left"
    fi
    # A log plays to its last whole line.
    last=$(grep -a '^[0-9][0-9]* ' $where/log 2>/dev/null | tail -1 | cut -d' ' -f1)
    if [ "${last:-0}" -gt 0 ]; then
        replayed=$((replayed + 1))
        (cd whole-$kind && "$program" run tree/scenes/dodgeball.yaml --input ../$where/log --steps "$last" --record ../played.sqlite \
            --record-every "$([ $kind = reloads ] && echo 0.5 || echo 0.1)" --checkpoint 1e6 --checkpoint-dir ../none --quiet) >err 2>&1
        left=$(strangers played.sqlite whole-$kind/r.sqlite)
        [ "$left" = "ok 0 0 " ] || bad "kill $k: the log plays to another run: $left $(head -3 err)"
        rm -rf played.sqlite* none
    fi
    if ls $where/ck/*.checkpoint >/dev/null 2>&1; then
        resumed=$((resumed + 1))
        (cd $where && "$program" resume ck --quiet) >err 2>&1 || bad "kill $k: $(head -3 err)"
        [ "$(contents $where/r.sqlite)" = "$(contents whole-$kind/r.sqlite)" ] || bad "kill $k: it goes on to another recording"
        [ $kind = reloads ] || diff -rq $where/report whole-report/report >err || bad "kill $k: another report: $(head -3 err)"
        [ $kind = report ] || diff -rq $where/data whole-reloads/data >err || bad "kill $k: other data: $(head -3 err)"
        find $where -name '*.part' | grep -q . && bad "kill $k: a part is left: $(find $where -name '*.part')"
    fi
    good=$((good + 1 - wrong))
done
[ $good = "$kills" ] && [ $((4 * resumed)) -ge $((kills * 2)) ]
verdict "of $kills runs that were killed, $good left whole files: $resumed went on from a checkpoint to the whole run's recording and data, $replayed logs played to it ($reloaded with behaviours that were saved, $writing killed in a checkpoint, $reporting in a report)" $?
