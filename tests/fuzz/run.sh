#!/bin/bash
# tests/fuzz/run.sh [NAME]: fuzzes every target, or one, for TIME seconds each, from its seeds and from what
# earlier rounds left in $B/corpus. Prints "ok NAME" with the inputs that were run, the edges that were reached
# and the processor time, or "not ok NAME" with the file of the input: `$B/fuzz/NAME FILE` runs it once more.
set -u
cd "$(dirname "$0")/../.."
B=${B:-build/fuzz} TIME=${TIME:-60}
. tests/fuzz/seeds.sh
[ -w /dev/shm ] && export TMPDIR=${TMPDIR:-/dev/shm} # a file for each input: a disk would be waited for
status=0
mkdir -p "$B/findings"
# Words of the reference pages, which libFuzzer puts into inputs.
grep -ohE '`[a-z_]+`' scripts/scene.md scripts/behaviour.md scripts/input.md | sort -u | tr '`' '"' >"$B/words"
TIMEFORMAT='%U %S'
for target in tests/fuzz/${1:-*}.c; do
    name=$(basename "$target" .c)
    seeds "$name" "$B/seeds/$name" || exit 1
    mkdir -p "$B/corpus/$name"
    largest=4096
    case $name in checkpoint | recording | schema) largest=200000 ;; scene | behaviour) largest=20000 ;; esac
    { time ASAN_OPTIONS=detect_leaks=1 "$B/fuzz/$name" -max_total_time="$TIME" -timeout=120 -rss_limit_mb=2560 -max_len=$largest -close_fd_mask=3 \
        -dict="$B/words" \
        -print_final_stats=1 -artifact_prefix="$B/findings/$name-" "$B/corpus/$name" "$B/seeds/$name" >"$B/$name.log" 2>&1; } 2>"$B/$name.time"
    good=$?
    runs=$(awk '/stat::number_of_executed_units/ {print $2}' "$B/$name.log")
    edges=$(grep -oE 'cov: [0-9]+' "$B/$name.log" | tail -1 | cut -d ' ' -f 2)
    spent=$(awk '{printf "%.1f", $1 + $2}' "$B/$name.time")
    if [ $good = 0 ]; then
        echo "ok $name: ${runs:-0} inputs, ${edges:-0} edges, $spent s of processor time"
    else
        echo "not ok $name: $(grep -E 'ERROR|does not hold|runtime error|expected:' "$B/$name.log" | head -3)"
        grep -E '^ *#[0-9]+ ' "$B/$name.log" | grep -E 'core/|tests/' | head -6
        ls -t "$B/findings/$name"-* 2>/dev/null | head -1
        status=1
    fi
done
exit $status
