#!/bin/bash
# tests/faults/run.sh [PART]...: lets one thing fail in small runs of every command, the n-th each time: an
# allocation (anybody's: the engine's, Lua's, SQLite's, Bullet's), a write, a file brought to the disk, a new name, a
# file opened, a thread. Each run ends with status 0 (it did without), 1 or 3, says why where it is not 0, and leaves
# whole files alone: no half-written ones, no damaged recording. FAULTS is how many n are tried for each command and
# part (of writes, the message itself may be what fails), spread over all that there are; "all": every one.
# COMMANDS: their names, of a few alone. Prints "ok ..." with what was counted.
set -u
cd "$(dirname "$0")/../.."
B=${B:-build/release} FAULTS=${FAULTS:-all}
program=${JOSTLE:-$PWD/$B/jostle}
look=$PWD/tests/page/look.py
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
alloc=$work/alloc.so
${CC:-gcc} -shared -fPIC -O1 -o "$alloc" tests/faults/alloc.c || exit 1
scene=$PWD/scenes/running-through.yaml log=$PWD/tests/data/session.input
"$program" run "$scene" --steps 4 --quiet --record "$work/a.sqlite" --checkpoint 0.05 --checkpoint-dir "$work/saved" || exit 1
cp -r "$work/saved" "$work/saved.first"
"$program" sweep "$scene" --set groups.runner.set.mass=60,70 --seeds 2 --steps 2 --quiet --out "$work/runs.sqlite" || exit 1
mkdir "$work/parts"
for only in 1 2; do
    "$program" sweep "$scene" --set groups.runner.set.mass=60,70 --steps 2 --quiet --only $only --out "$work/parts/$only.sqlite" || exit 1
done
mkdir -p "$work/claims" # of one that runs a scene for two steps
cp "$scene" "$work/scene.yaml"
cp behaviours/*.lua "$work/"
cat >"$work/claims/one.lua" <<'END'
return claim { id = "C1", title = "t", source = "s", text = "t", runs = { a = { scene = "../scene.yaml", duration = 0.1 } },
  measure = function(run) return { agents = run.a.summary.agents } end,
  expect = { { "agents", what = "w", source = "26", band = { 26, 26 } } } }
END

# NAME COMMAND...; what it writes lies in the folder out. Resuming writes into the files of the run before.
commands=(
    "run run $scene --steps 3 --quiet --summary out/s.json --record out/r.sqlite --log-input out/l.input"
    "threads run $scene --steps 3 --quiet --threads 2 --summary out/s.json"
    "data run $scene --steps 3 --quiet --data out/data"
    "kept run $scene --steps 3 --quiet --data out/data --checkpoint 0.05 --checkpoint-dir out/saved --record out/r.sqlite"
    "drawn run $scene --steps 2 --quiet --report out/report --no-half-step"
    "sweep sweep $scene --set groups.runner.set.mass=60,70 --steps 2 --jobs 1 --quiet --out out/runs.sqlite --csv out/runs.csv"
    "only sweep $scene --set groups.runner.set.mass=60,70 --steps 2 --quiet --only 1 --out out/one.sqlite"
    "merge sweep --merge $work/parts --out out/all.sqlite --canonical --quiet"
    "compare compare $work/runs.sqlite --json out/c.json"
    "bench bench $scene --steps 2 --warm-up 0 --csv out/b.csv"
    "reproduce reproduce --claims $work/claims --seeds 1 --jobs 1 --out out/all --quiet"
    "report report $work/a.sqlite --summary out/s.json"
    "render render $work/a.sqlite --at 0.05 --out out/a.svg"
    "check check $scene $PWD/behaviours/walker.lua"
    "test test $PWD/tests/lua/kick_test.lua"
    "new new scene mine"
    "mods mod list $scene"
    "reference reference scenes"
    "resume resume $work/saved --for 0.4 --quiet"
    "view view $work/a.sqlite --page $PWD/build/page"
    "live run $scene --view --view-wait 0 --fast --for 0.05 --quiet --page $PWD/build/page"
)
status=0

# Whether what a run left is whole; else why not.
whole() {
    local file
    find out -name '*.part' | grep -q . && echo "a .part file is left"
    for file in out/*.sqlite; do
        [ -s "$file" ] && [ "$(sqlite3 "$file" 'PRAGMA integrity_check' 2>&1)" != ok ] && echo "$file is damaged"
    done
    for file in out/*.json; do
        [ -f "$file" ] && ! python3 -m json.tool "$file" >/dev/null 2>&1 && echo "$file is cut"
    done
    [ -f out/a.svg ] && ! grep -q '</svg>' out/a.svg && echo "out/a.svg is cut"
}
# What a command goes on from, as it was.
fresh() {
    case $1 in
    resume) rm -rf saved; cp -r saved.first saved ;;
    new) rm -rf mine* ;;
    esac
}
# PROGRAM ARGS...: runs it; who serves a page is told to end once its page was asked for, and somebody looked at
# what it sends.
run() {
    local pid child address
    if [[ " $* " != *" $program view "* && " $* " != *" --view "* ]]; then
        timeout -s KILL 60 "$@" >said 2>&1 </dev/null
        return
    fi
    : >said
    timeout -s KILL 60 "$@" >said 2>&1 </dev/null & pid=$!
    until address=$(grep -o 'http://[^ ]*' said) || ! kill -0 $pid 2>/dev/null; do sleep 0.05; done
    if [[ $address =~ ^http://([0-9.]+):([0-9]+)(/.*)$ ]]; then
        (
            exec 3<>"/dev/tcp/${BASH_REMATCH[1]}/${BASH_REMATCH[2]}" || exit
            printf 'GET %s HTTP/1.1\r\nHost: %s:%s\r\nConnection: close\r\n\r\n' "${BASH_REMATCH[3]}" "${BASH_REMATCH[1]}" "${BASH_REMATCH[2]}" >&3
            timeout 5 cat <&3
        ) >page 2>&1
        timeout 5 python3 "$look" "$address" 1 >/dev/null 2>&1
        child=$(pgrep -P $pid)
        [ "$1" != strace ] || child=$(pgrep -P "$child")
        [ -z "$child" ] || kill -INT $child 2>/dev/null
    fi
    wait $pid
    local got=$?
    [ $got = 130 ] && [ -n "${child-}" ] && return 0 # as it was told
    return $got
}
# PART N COMMAND...
once() {
    local part=$1 n=$2; shift 2
    rm -rf out; mkdir out
    case $part in
    memory) run env FAULT_AT="$n" LD_PRELOAD="$alloc" "$program" "$@" ;;
    *) run strace --seccomp-bpf -qq -f -o "$work/trace" -e trace="$calls" -e inject="$calls:error=$error:when=$n" "$program" "$@" ;;
    esac
}
# How often a part happens in a command.
count() {
    local part=$1; shift
    rm -rf out; mkdir out
    case $part in
    memory) run env FAULT_COUNT=9 LD_PRELOAD="$alloc" "$program" "$@" 9>"$work/count"; sort -n "$work/count" | tail -n 1 ;; # of the command, or of a child that goes on from it
    *) run strace --seccomp-bpf -qq -f -o "$work/trace" -e trace="$calls" "$program" "$@"; grep -c "(" "$work/trace" ;;
    esac
}
sweep() { # PART NAME COMMAND...
    local part=$1 name=$2 n got why all tried=0 degraded=0 wrong=0 k most; shift 2
    fresh "$name"
    all=$(count "$part" "$@")
    [ "${all:-0}" -gt 0 ] || { echo "ok $part of $name: there is none"; return; }
    most=$FAULTS
    [ "$most" = all ] || [ "$most" -gt "$all" ] && most=$all
    for ((k = 0; k < most; k++)); do
        n=$((1 + k * all / most))
        fresh "$name"
        once "$part" $n "$@"
        got=$?
        why=$(whole)
        tried=$((tried + 1))
        [ $got = 0 ] && degraded=$((degraded + 1))
        case $got in 0 | 1 | 3) ;; 127) [ "$part" = open ] || why="status $got $why" ;; *) why="status $got $why" ;; esac
        [ $got != 0 ] && [ ! -s said ] && [ "$part" != write ] && why="nothing is said $why"
        if [ -n "$why" ]; then
            wrong=$((wrong + 1))
            [ $wrong -le 3 ] && { echo "  $part $n of $name: $why"; head -2 said; }
        fi
    done
    if [ $wrong = 0 ]; then
        echo "ok $part of $name: $tried of $all failed in turn, $degraded times it did without"
    else
        echo "not ok $part of $name: $wrong of $tried"
        status=1
    fi
}

cd "$work" || exit 1
for part in ${*:-memory write page truncate sync rename open thread}; do
    case $part in
    memory) ;;
    write) calls=write error=ENOSPC ;;
    page) calls=pwrite64 error=ENOSPC ;;
    truncate) calls=ftruncate error=EIO ;;
    sync) calls=fsync,fdatasync error=EIO ;;
    rename) calls=rename error=EACCES ;;
    open) calls=openat error=EMFILE ;;
    thread) calls=clone,clone3 error=EAGAIN ;;
    *) echo "no part: $part" >&2; exit 2 ;;
    esac
    if [ "$part" != memory ] && ! strace -qq -o "$work/trace" true 2>/dev/null; then
        echo "ok $part: left out, as strace cannot trace here"
        continue
    fi
    for command in "${commands[@]}"; do
        set -- $command
        [ -z "${COMMANDS-}" ] || [[ " $COMMANDS " == *" $1 "* ]] || continue
        sweep "$part" "$@"
    done
done
exit $status
