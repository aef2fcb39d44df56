#!/bin/bash
# The command line of the live page: its address, its end, and refusals. The page and its server are tested in
# tests/unit/view_*.c and live_view.c.
set -u
cd "$(dirname "$0")/../.."
. tests/scenes/lib.sh
mkdir -p "$work/page"
echo "the page" >"$work/page/index.html"
page="--page $work/page"

request() { # PORT PATH: prints the answer to a plain request
    exec 3<>"/dev/tcp/127.0.0.1/$1" || return 1
    printf 'GET %s HTTP/1.1\r\nHost: localhost:%s\r\nConnection: close\r\n\r\n' "$2" "$1" >&3
    timeout 20 cat <&3
    exec 3<&- 3>&-
}
"$JOSTLE" run scenes/circle.yaml --view $page --view-wait 0 --summary "$work/summary" --log-input "$work/log" \
    --checkpoint 0.05 --checkpoint-dir "$work/ck" \
    >"$work/said" 2>"$work/errors" </dev/null &
pid=$!
for _ in $(seq 200); do grep -q token "$work/said" && break; sleep 0.1; done
address=$(cat "$work/said")
[[ "$address" =~ ^http://127\.0\.0\.1:([0-9]+)(/\?token=[0-9a-f]{32})$ ]]
verdict "the address is printed, alone" $?
port=${BASH_REMATCH[1]:-0} path=${BASH_REMATCH[2]:-/}
request "$port" "$path" | grep -q "the page"
verdict "the address opens the page" $?
request "$port" "/" | grep -q "403 Forbidden"
verdict "requests without the token are refused" $?
"$JOSTLE" run scenes/circle.yaml --view="$port" $page >/dev/null 2>"$work/second"
[ $? = 1 ] && grep -q "port $port: Address already in use" "$work/second"
verdict "a used port is an error" $?
"$JOSTLE" run scenes/circle.yaml --view $page --view-wait 3600 --summary "$work/waited" >/dev/null 2>&1 </dev/null &
waiting=$!
sleep 0.5
kill -INT $pid
wait $pid
[ $? = 130 ]; verdict "Ctrl-C ends it with the status of a run" $?
[ -n "$(figure hash <"$work/summary")" ]
verdict "with a summary" $?
grep -qF "Files: input log $work/log." <(tr '\n' ' ' <"$work/errors"); verdict "the last lines list the files of the run" $?
hash=$(figure hash <"$work/summary")
same_hash "a run without a page has the same hash" "$hash" \
    "$(hash_of "$JOSTLE" scenes/circle.yaml --steps "$(figure steps <"$work/summary")" --input "$work/log")"

"$JOSTLE" resume "$work/ck" --quiet --for "$(awk -v n="$(figure steps <"$work/summary")" 'BEGIN {print n * 0.05}')" --summary "$work/rest" 2>"$work/errors"
same_hash "its checkpoint can be resumed to the same hash" "$hash" "$(figure hash <"$work/rest")"

kill -TERM $waiting
wait $waiting
[ $? = 143 ]; verdict "SIGTERM: status 143" $?
[ "$(figure steps <"$work/waited")" = 0 ]
verdict "a run waits until its page is open" $?

refuses() { # NAME STATUS TEXT ARGS...: checks that the call is refused
    local name=$1 status=$2 text=$3; shift 3
    timeout 60 "$JOSTLE" run "$@" >"$work/out" 2>&1 </dev/null
    local got=$?
    [ $got = "$status" ] && grep -q -e "$text" "$work/out" || { got=$?; sed 's/^/    /' "$work/out"; false; }
    verdict "$name" $?
}
"$JOSTLE" run scenes/running-through.yaml --steps 2 --quiet --record "$work/r.sqlite"
for command in "run scenes/circle.yaml --view" "view $work/r.sqlite"; do
    timeout -s KILL 60 "$JOSTLE" $command $page >/dev/full 2>"$work/errors" </dev/null
    [ $? = 1 ] && grep -q "cannot write to standard output: No space" "$work/errors"
    verdict "${command%% *} ends where its address cannot be written" $?
done
for command in "run scenes/circle.yaml --view" "view $work/r.sqlite"; do
    (sleep 0.3; timeout -s KILL 60 "$JOSTLE" $command $page; echo $? >"$work/status") 2>/dev/null </dev/null | true
    [ "$(cat "$work/status")" = 1 ]; verdict "  also if nobody reads it" $?
    env --default-signal=HUP "$JOSTLE" $command $page >"$work/said" 2>/dev/null </dev/null &
    pid=$!
    for _ in $(seq 100); do grep -q token "$work/said" && break; sleep 0.1; done
    kill -HUP $pid; wait $pid
    [ $? = 129 ]; verdict "SIGHUP ends ${command%% *}: status 129" $?
done
refuses "a page that is not there" 1 "give its folder by --page" scenes/circle.yaml --view --page /nowhere
refuses "an address that is none" 1 "no address" scenes/circle.yaml --view $page --view-address here
refuses "a port that is none" 2 "whole number from 1 to 65535" scenes/circle.yaml --view=eighty
refuses "pictures of a live run" 2 "--report" scenes/circle.yaml --view $page --report "$work/report"
refuses "options of the page without it" 2 "go with --view" scenes/circle.yaml --fast
refuses "a scene that is wrong" 3 "nonsense" "$(printf 'jostle: 1\nnonsense: 1\n' >"$work/wrong.yaml"; echo "$work/wrong.yaml")" --view $page
