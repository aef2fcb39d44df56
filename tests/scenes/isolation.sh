# Scenes of others: read by a process of their own, which reaches nothing beyond their folders and has its limits.
. tests/scenes/lib.sh
program=$(case $JOSTLE in /*) echo "$JOSTLE" ;; *) echo "$PWD/$JOSTLE" ;; esac)
cd "$work" || exit 1
mkdir -p scenes behaviours elsewhere
says() { # NAME STATUS TEXT COMMAND...
    local name=$1 status=$2 text=$3; shift 3
    timeout -s KILL 60 "$@" >out 2>&1 </dev/null
    local got=$?
    if [ $got = "$status" ] && { [ -z "$text" ] || grep -qF -- "$text" out; }; then echo "ok $name"; else
        echo "not ok $name: status $got, wanted $status and '$text'"; head -5 out; fi
}
# The limits of a process that commands set: a line each, soft and hard; a number or "unlimited".
limits_of() { sed -n 's/^\(Max \(cpu time\|file size\|open files\|address space\)\) *\([^ ]*\) *\([^ ]*\).*/\1 \3 \4/p' "/proc/$1/limits" 2>/dev/null; }
child_of() { pgrep -P "$1" | head -1; }
soon() { for _ in $(seq 100); do "$@" && return; sleep 0.1; done; return 1; }
has_all() { [ "$(limits_of "$1" | grep -c 'Max [a-z ]* [0-9]')" = 4 ]; }
has_child_alike() { [ -n "$(child_of "$1")" ] && [ "$(limits_of "$(child_of "$1")")" = "$(limits_of "$1")" ]; }
bounded() { soon has_all "$2"; verdict "$1" $?; } # NAME PROCESS
alike() { soon has_child_alike "$2"; verdict "$1" $?; } # NAME PROCESS: some child has its limits
rest='return machine { name = "m", start = "S", states = { S = { steer = hold } } }'
echo "$rest" >elsewhere/away.lua
echo "$rest" >behaviours/near.lua
scene() { printf 'jostle: 1\n%sgroups: {g: {behaviour: %s, at: [[0, 0]]}}\n' "$2" "$1" >scenes/s.yaml; }

scene near.lua
says "a scene with its behaviour in ../behaviours" 0 "" "$program" run scenes/s.yaml --quiet --steps 2
mkdir -p scripts
echo 'return { pace = 1 }' >scripts/manners.lua
echo "local manners = require 'manners' assert(manners.pace == 1) $rest" >behaviours/kind.lua
scene kind.lua
says "  which requires a file of ../scripts" 0 "" "$program" run scenes/s.yaml --quiet --steps 2
says "the version says what the kernel has" 0 "scenes are read by a process with" "$program" --version
if ! grep -q "no Landlock" out; then
    scene ../elsewhere/away.lua
    says "a behaviour from elsewhere is not read" 3 "Permission denied" "$program" run scenes/s.yaml --quiet --steps 2
    says "  which says how it would be" 3 "with --trusted" "$program" run scenes/s.yaml --quiet --steps 2
    says "  but by one who trusts the scene" 0 "" "$program" run scenes/s.yaml --quiet --steps 2 --trusted
fi

# ---- whole commands that read files of others ----
says "a run is recorded" 0 "" "$program" run scenes/s.yaml --trusted --quiet --steps 40 --record r.sqlite
if ! "$program" --version | grep -q "no Landlock"; then
    says "check reads its folders alone" 3 "Permission denied" "$program" check scenes/s.yaml
    says "  or what its user trusts" 0 "" "$program" check --trusted scenes/s.yaml
    mkdir -p tests; echo 'test("away", function() scene { groups = { g = { behaviour = "../elsewhere/away.lua", at = { { 0, 0 } } } } } truthy(true) end)' >tests/a_test.lua
    says "so do tests" 1 "Permission denied" "$program" test tests
    says "  or what their user trusts" 0 "1 passed" "$program" test --trusted tests
    says "what is timed reads its folders alone" 3 "Permission denied" "$program" bench scenes/s.yaml --steps 2 --warm-up 0
    says "  or what its user trusts" 0 "" "$program" bench scenes/s.yaml --steps 2 --warm-up 0 --trusted
    mkdir -p scenes/claims scenes/mods/away elsewhere/claims
    cat >scenes/claims/c.lua <<'END'
return claim { id = "C1", title = "t", source = "s", text = "t", runs = { a = { scene = "../s.yaml", duration = 0.1 } },
  measure = function(run) return { agents = run.a.summary.agents } end,
  expect = { { "agents", what = "w", source = "1", band = { 1, 1 } } } }
END
    says "runs of claims read their folders alone" 1 "Permission denied" "$program" reproduce --out out-claims --quiet
    says "  nor leave their results where nobody asked for them" 0 "" test ! -e build
    cp scenes/claims/c.lua elsewhere/claims/; ln -s "$PWD/elsewhere/claims/c.lua" scenes/claims/linked.lua
    says "a claim that lies elsewhere is not read" 3 "symbolic links are not followed" "$program" reproduce --out out-claims --quiet
    rm scenes/claims/linked.lua
    printf 'name: away\nversion: 1.0.0\ntitle: t\n' >scenes/mods/away/mod.yaml
    says "a mod is turned on by a process that writes its list alone" 0 "" env XDG_CONFIG_HOME="$PWD/cfg" "$program" mod enable scenes/mods/away
    cat >tests/a_test.lua <<'END'
test("long", function()
  local s = scene { groups = { g = { behaviour = "near.lua", count = 400, fill = "grid", spacing = 1, ["in"] = "p" } },
    places = { p = { polygon = { { 0, 0 }, { 30, 0 }, { 30, 30 }, { 0, 30 } } } } }
  for _ = 1, 100 do s:run(1000) end
end)
END
    says "a command that takes all its processor time says so" 1 "with --trusted there is no limit" \
        prlimit --cpu=6 "$program" test tests
    mkdir -p pictures
    says "a drawn scene reads its folder alone" 3 "Permission denied" "$program" render scenes/s.yaml --out pictures/o.svg --quiet
    says "  or what its user trusts" 0 "" "$program" render scenes/s.yaml --out pictures/o.svg --quiet --trusted
    printf '#!/bin/sh\ntouch "%s/elsewhere/taken"\n' "$PWD" >elsewhere/gnuplot; chmod +x elsewhere/gnuplot
    PATH=$PWD/elsewhere:$PATH "$program" report r.sqlite --out pictures/report >out 2>&1
    [ ! -e elsewhere/taken ] && [ -s pictures/report/index.html ]; verdict "programs are those of the system alone" $?
    timeout 20 "$program" view r.sqlite --port 8790 >page 2>&1 & pages=$!
    for _ in $(seq 100); do grep -q token page && break; sleep 0.1; done
    grep -q 'Seccomp:[[:space:]]*2' "/proc/$(pgrep -P $pages)/status"; verdict "a page of a recording is served by a confined process" $?
    bounded "  which has its limits" "$(child_of $pages)"
    kill $pages; wait $pages
fi
scene near.lua
mkdir -p inner/deep
says "a run is kept, and recorded elsewhere" 0 "" \
    "$program" run scenes/s.yaml --quiet --steps 40 --checkpoint 1 --checkpoint-dir "$PWD/inner/deep/kept" \
    --record "$PWD/elsewhere/kept.sqlite"
if ! "$program" --version | grep -q "no Landlock"; then
    says "a checkpoint does not write where it likes" 1 "goes on there with --trusted" \
        env -C inner "$program" resume deep/kept --quiet --for 3
    says "  unless its user trusts it" 0 "" env -C inner "$program" resume deep/kept --quiet --for 3 --trusted
fi
printf 'jostle: 1\nplaces: {p: {polygon: [[0, 0], [60, 0], [60, 60], [0, 60]]}}\ngroups: {g: {behaviour: near.lua, count: 1000, fill: grid, in: p}}\n' >inner/large.yaml
cp behaviours/near.lua inner/
says "a large run is kept, and recorded" 0 "" "$program" run inner/large.yaml --quiet --steps 40 --checkpoint 1 --checkpoint-dir inner/large --record inner/large.sqlite
says "a run that goes on for too long says so" 1 "with --trusted there is no limit" prlimit --cpu=6 "$program" resume inner/large --quiet --for 1e6
says "  and one that begins anew" 1 "with --trusted there is no limit" prlimit --cpu=6 "$program" run inner/large.yaml --quiet --for 1e6
"$program" run inner/large.yaml --quiet --for 1e6 2>/dev/null & runs=$!
bounded "  which has its other limits, too" $runs
kill $runs; wait $runs

# ---- many runs ----
"$program" sweep inner/large.yaml --seeds 1 --for 1e6 --jobs 1 --out inner/sweep.sqlite --quiet 2>/dev/null & runs=$!
bounded "a sweep has its limits" $runs
alike "  and so has each of its runs" $runs
kill $runs; wait $runs
memory_of() { limits_of "$1" | sed -n 's/Max address space \([0-9]*\).*/\1/p'; }
shares() { local of=$(memory_of "$(child_of "$1")"); [ -n "$of" ] && [ "$((of * 9 / 5))" -lt "$(memory_of "$1")" ]; }
"$program" sweep inner/large.yaml --seeds 2 --for 1e6 --jobs 2 --out inner/sweep.sqlite --quiet 2>/dev/null & runs=$!
soon shares $runs; verdict "  but for memory, which those that run at once share" $?
kill $runs; wait $runs
says "a run of a sweep that takes all its processor time says so, and is one that failed" 1 \
    "large.yaml, seed 1 failed: it took the processor time that its process may" \
    prlimit --cpu=6 "$program" sweep inner/large.yaml --seeds 1 --for 1e6 --out inner/late.sqlite
"$program" compare inner/large.yaml scenes/s.yaml --seeds 1 --for 1e6 --jobs 1 --out inner/compared --quiet >/dev/null 2>&1 & runs=$!
bounded "a comparison has its limits" $runs
alike "  and so has each of its runs" $runs
kill $runs; wait $runs
"$program" sweep inner/large.yaml --seeds 1 --for 1e6 --jobs 1 --out inner/trusted.sqlite --quiet --trusted 2>/dev/null & runs=$!
alike "  unless its user trusts it: then its runs have those" $runs
[ "$(limits_of $runs)" = "$(limits_of $$)" ]; verdict "  of who began it" $?
kill $runs; wait $runs
[ "$(sqlite3 inner/large.sqlite 'PRAGMA integrity_check')" = ok ] && [ "$(sqlite3 inner/large.sqlite 'SELECT max(frame) > 100 FROM trajectory_data')" = 1 ]
verdict "  and leaves a recording that is whole" $?
says "it goes on below the working folder" 0 "" "$program" resume inner/deep/kept --quiet --for 4
says "confined, a recording is measured, its pictures drawn by gnuplot" 0 "" "$program" report r.sqlite --scene scenes/s.yaml --out new/report
[ -s new/report/index.html ] && ls new/report/*.png >out; verdict "  into a folder that was not there" $?
sqlite3 unsorted.sqlite "CREATE TABLE metadata(key TEXT, value TEXT); INSERT INTO metadata VALUES('version', '2'), ('fps', '10');
    CREATE TABLE trajectory_data(frame INTEGER, id INTEGER, pos_x REAL, pos_y REAL, ori_x REAL, ori_y REAL);
    WITH RECURSIVE n(k) AS (SELECT 0 UNION ALL SELECT k + 1 FROM n WHERE k < 79999)
    INSERT INTO trajectory_data SELECT 400 - k % 400, k / 400, k / 400 % 20, k / 400 / 20, 1, 0 FROM n"
says "a long recording without an index is put in order" 0 "" "$program" report unsorted.sqlite --summary sorted.json
says "a recording is drawn" 0 "" "$program" render r.sqlite --out new/one.svg --quiet
says "a scene is drawn" 0 "" "$program" render scenes/s.yaml --at 1 --out two.svg --quiet
says "a mod is listed, with what is wrong with it" 3 "this mod lacks" "$program" mod list scenes/s.yaml

# ---- a behaviour that is never read to its end, as its scene lifts the limits ----
echo 'while true do end' >behaviours/endless.lua
scene endless.lua 'limits: {load_instructions: 1e9}
'
says "reading that never ends, ends, and names the file" 3 "behaviours/endless.lua: error: reading this scene takes more" \
    bash -c 'ulimit -t 1; exec "$0" run scenes/s.yaml --quiet --steps 2' "$program"
says "  and says how long it took" 3 "processor time than it may (1 s)" \
    bash -c 'ulimit -t 1; exec "$0" run scenes/s.yaml --quiet --steps 2' "$program"
ends() { # NAME SIGNAL TEXT: whoever reads the scene gets the signal
    "$program" run scenes/s.yaml --quiet --steps 2 >out 2>&1 & run=$!
    for _ in $(seq 100); do child=$(pgrep -P $run) && break; sleep 0.05; done; sleep 0.3
    kill -s "$2" "$child"; wait $run
    local got=$?
    [ $got = 3 ] && grep -qF "behaviours/endless.lua: error: reading this scene $3" out; verdict "$1" $?
}
ends "who is killed is not said to be slow" KILL "was ended from outside"
ends "nor is who makes a forbidden call" SYS "tried to start a program"
ends "nor is who breaks" ABRT "broke the process that read it (Aborted)"
echo 'local t = {} for i = 1, 1e9 do t[i] = ("x"):rep(1e6) .. i end' >behaviours/greedy.lua
scene greedy.lua 'limits: {load_instructions: 1e9, memory: 1024, block: 1024}
'
if (ulimit -v 400000; "$program" --version) >out 2>&1; then # a build that checks memory needs terabytes
    says "who takes more memory than there is, is told so" 3 "takes more memory than there is" \
        bash -c 'ulimit -v 400000; exec "$0" run scenes/s.yaml --quiet --steps 2' "$program"
fi

# ---- what was vetted is what runs ----
scene near.lua
vetted=$("$program" run scenes/s.yaml --quiet --steps 20 --summary - | grep '"hash"')
trusted=$("$program" run scenes/s.yaml --quiet --steps 20 --summary - --trusted | grep '"hash"')
[ -n "$vetted" ] && [ "$vetted" = "$trusted" ]; verdict "one hash, vetted or trusted" $?

# ---- what is saved while a scene runs is read by such a process too, and the run goes on meanwhile ----
await() { for _ in $(seq 300); do grep -qF -- "$1" said && return 0; sleep 0.1; done; head -5 said; return 1; } # TEXT
begun() { for _ in $(seq 300); do pgrep -P $run >out && [ -s log ] && { sleep 0.5; return; }; sleep 0.1; done; head -5 said; }
reader() { for _ in $(seq 100); do child=$(pgrep -P "$(pgrep -P $run)") && return 0; sleep 0.1; done; return 1; }
echo "$rest" >behaviours/edited.lua
scene edited.lua 'limits: {load_instructions: 1e9}
'
for kind in --watch --view=8791; do
    echo "$rest" >behaviours/edited.lua
    "$program" run scenes/s.yaml --quiet --for 1e6 $kind --log-input log >said 2>&1 & run=$!
    begun
    echo "while true do end $rest" >behaviours/edited.lua
    reader && grep -q 'Seccomp:[[:space:]]*2' "/proc/$child/status"; verdict "$kind: a saved behaviour is read by a confined process" $?
    kill -ABRT "$child"
    await "edited.lua: reading this file broke the process that read it (Aborted)"; verdict "$kind:   whose end is told" $?
    echo "-- good again
$rest" >behaviours/edited.lua
    await "reload 1 is live"; verdict "$kind:   and what is saved then goes live" $?
    grep -qF -- "-- good again" log; verdict "$kind:   from the bytes that were read" $?
    echo "while true do end $rest" >behaviours/edited.lua
    reader; began=$(date +%s%N); kill -INT $run; wait $run; status=$?
    [ $(($(date +%s%N) - began)) -lt 8000000000 ] && { [ $status = 130 ] || [ $kind != --watch ]; }; verdict "$kind: who ends a run does not wait for what is read (status $status)" $?
    sleep 0.2; [ ! -e "/proc/$child" ]; verdict "$kind:   and leaves no process behind" $?
done
if ! "$program" --version | grep -q "no Landlock"; then
    echo "$rest" >behaviours/edited.lua
    "$program" run scenes/s.yaml --quiet --for 1e6 --watch --log-input log >said 2>&1 & run=$!
    begun
    printf 'jostle: 1\nlimits: {load_instructions: 1e9}\nwalls: [{file: %s/elsewhere/plan.wkt}]\ngroups: {g: {behaviour: edited.lua, at: [[0, 0]]}}\n' "$PWD" >scenes/s.yaml
    await "plan.wkt"; verdict "a saved scene does not read elsewhere" $?
    kill -INT $run; wait $run
fi
exit 0 # of what was ended by a signal, the status is no verdict
