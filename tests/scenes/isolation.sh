# Vetting and confinement: scenes of strangers are read by a process of their own, which cannot reach beyond their
# folders and has limits.
. tests/scenes/lib.sh
program=$(case $JOSTLE in /*) echo "$JOSTLE" ;; *) echo "$PWD/$JOSTLE" ;; esac)
cd "$work" || exit 1
mkdir -p scenes behaviours elsewhere
says() { # NAME STATUS TEXT COMMAND...: checks exit status and a text in the output
    local name=$1 status=$2 text=$3; shift 3
    timeout -s KILL 60 "$@" >out 2>&1 </dev/null
    local got=$?
    if [ $got = "$status" ] && { [ -z "$text" ] || grep -qF -- "$text" out; }; then echo "ok $name"; else
        echo "not ok $name: status $got, wanted $status and '$text'"; head -5 out; fi
}
# limits_of PROCESS: prints the limits of a process that commands set, one per line: a number or "unlimited"
limits_of() { sed -n 's/^\(Max \(cpu time\|file size\|open files\|address space\)\) *\([^ ]*\) *\([^ ]*\).*/\1 \3 \4/p' "/proc/$1/limits" 2>/dev/null; }
child_of() { pgrep -P "$1" | head -1; }
soon() { for _ in $(seq 100); do "$@" && return; sleep 0.1; done; return 1; }
has_all() { [ "$(limits_of "$1" | grep -c 'Max [a-z ]* [0-9]')" = 4 ]; }
has_child_alike() { [ -n "$(child_of "$1")" ] && [ "$(limits_of "$(child_of "$1")")" = "$(limits_of "$1")" ]; }
bounded() { soon has_all "$2"; verdict "$1" $?; } # NAME PROCESS: checks that a process has all limits
alike() { soon has_child_alike "$2"; verdict "$1" $?; } # NAME PROCESS: checks that a child of a process has the same limits
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
says "  and a file of ../scripts that it requires" 0 "" "$program" run scenes/s.yaml --quiet --steps 2
says "--version prints what the kernel supports" 0 "scenes are read by a process with" "$program" --version
if ! grep -q "no Landlock" out; then
    scene ../elsewhere/away.lua
    says "a behaviour outside the scene's folders is not read" 3 "Permission denied" "$program" run scenes/s.yaml --quiet --steps 2
    says "  and the message names --trusted" 3 "with --trusted" "$program" run scenes/s.yaml --quiet --steps 2
    says "  with --trusted it is read" 0 "" "$program" run scenes/s.yaml --quiet --steps 2 --trusted
fi

# ---- whole commands that read files of others ----
says "a vetted run is recorded" 0 "" "$program" run scenes/s.yaml --trusted --quiet --steps 40 --record r.sqlite
if ! "$program" --version | grep -q "no Landlock"; then
    says "check reads only its folders" 3 "Permission denied" "$program" check scenes/s.yaml
    says "  with --trusted also others" 0 "" "$program" check --trusted scenes/s.yaml
    mkdir -p tests; echo 'test("away", function() scene { groups = { g = { behaviour = "../elsewhere/away.lua", at = { { 0, 0 } } } } } truthy(true) end)' >tests/a_test.lua
    says "test reads only its folders" 1 "Permission denied" "$program" test tests
    says "  with --trusted also others" 0 "1 passed" "$program" test --trusted tests
    says "bench reads only its folders" 3 "Permission denied" "$program" bench scenes/s.yaml --steps 2 --warm-up 0
    says "  with --trusted also others" 0 "" "$program" bench scenes/s.yaml --steps 2 --warm-up 0 --trusted
    mkdir -p scenes/claims scenes/mods/away elsewhere/claims
    cat >scenes/claims/c.lua <<'END'
return claim { id = "C1", title = "t", source = "s", text = "t", runs = { a = { scene = "../s.yaml", duration = 0.1 } },
  measure = function(run) return { agents = run.a.summary.agents } end,
  expect = { { "agents", what = "w", source = "1", band = { 1, 1 } } } }
END
    says "runs of reproduce read only their folders" 1 "Permission denied" "$program" reproduce --out out-claims --quiet
    says "  and write only below --out" 0 "" test ! -e build
    cp scenes/claims/c.lua elsewhere/claims/; ln -s "$PWD/elsewhere/claims/c.lua" scenes/claims/linked.lua
    says "a claim outside the folder is not read" 3 "symbolic links are not followed" "$program" reproduce --out out-claims --quiet
    rm scenes/claims/linked.lua
    printf 'name: away\nversion: 1.0.0\ntitle: t\n' >scenes/mods/away/mod.yaml
    says "mod enable can write only the list of enabled mods" 0 "" env XDG_CONFIG_HOME="$PWD/cfg" "$program" mod enable scenes/mods/away
    cat >tests/a_test.lua <<'END'
test("long", function()
  local s = scene { groups = { g = { behaviour = "near.lua", count = 400, fill = "grid", spacing = 1, ["in"] = "p" } },
    places = { p = { polygon = { { 0, 0 }, { 30, 0 }, { 30, 30 }, { 0, 30 } } } } }
  for _ = 1, 100 do s:run(1000) end
end)
END
    says "a command that uses up its processor time says so" 1 "with --trusted there is no limit" \
        prlimit --cpu=6 "$program" test tests
    mkdir -p pictures
    says "render reads only its folder" 3 "Permission denied" "$program" render scenes/s.yaml --out pictures/o.svg --quiet
    says "  with --trusted also others" 0 "" "$program" render scenes/s.yaml --out pictures/o.svg --quiet --trusted
    printf '#!/bin/sh\ntouch "%s/elsewhere/taken"\n' "$PWD" >elsewhere/gnuplot; chmod +x elsewhere/gnuplot
    PATH=$PWD/elsewhere:$PATH "$program" report r.sqlite --out pictures/report >out 2>&1
    [ ! -e elsewhere/taken ] && [ -s pictures/report/index.html ]; verdict "only programs of the system are started" $?
    timeout 20 "$program" view r.sqlite --port 8790 >page 2>&1 & pages=$!
    for _ in $(seq 100); do grep -q token page && break; sleep 0.1; done
    grep -q 'Seccomp:[[:space:]]*2' "/proc/$(pgrep -P $pages)/status"; verdict "a page of a recording is served by a confined process" $?
    bounded "  with limits of memory and time" "$(child_of $pages)"
    kill $pages; wait $pages
fi
scene near.lua
mkdir -p inner/deep
says "a run writes a checkpoint, and a recording elsewhere" 0 "" \
    "$program" run scenes/s.yaml --quiet --steps 40 --checkpoint 1 --checkpoint-dir "$PWD/inner/deep/kept" \
    --record "$PWD/elsewhere/kept.sqlite"
if ! "$program" --version | grep -q "no Landlock"; then
    says "a checkpoint cannot make resume write outside its folders" 1 "goes on there with --trusted" \
        env -C inner "$program" resume deep/kept --quiet --for 3
    says "  with --trusted it can" 0 "" env -C inner "$program" resume deep/kept --quiet --for 3 --trusted
fi
printf 'jostle: 1\nplaces: {p: {polygon: [[0, 0], [60, 0], [60, 60], [0, 60]]}}\ngroups: {g: {behaviour: near.lua, count: 1000, fill: grid, in: p}}\n' >inner/large.yaml
cp behaviours/near.lua inner/
says "a large run writes a checkpoint and a recording" 0 "" "$program" run inner/large.yaml --quiet --steps 40 --checkpoint 1 --checkpoint-dir inner/large --record inner/large.sqlite
says "a resumed run that uses up its processor time says so" 1 "with --trusted there is no limit" prlimit --cpu=6 "$program" resume inner/large --quiet --for 1e6
says "  also a run from the beginning" 1 "with --trusted there is no limit" prlimit --cpu=6 "$program" run inner/large.yaml --quiet --for 1e6
"$program" run inner/large.yaml --quiet --for 1e6 2>/dev/null & runs=$!
bounded "  with the other limits too" $runs
kill $runs; wait $runs

# ---- many runs ----
"$program" sweep inner/large.yaml --seeds 1 --for 1e6 --jobs 1 --out inner/sweep.sqlite --quiet 2>/dev/null & runs=$!
bounded "a sweep has its limits" $runs
alike "  and each of its runs has the same" $runs
kill $runs; wait $runs
memory_of() { limits_of "$1" | sed -n 's/Max address space \([0-9]*\).*/\1/p'; }
shares() { local of=$(memory_of "$(child_of "$1")"); [ -n "$of" ] && [ "$((of * 9 / 5))" -lt "$(memory_of "$1")" ]; }
"$program" sweep inner/large.yaml --seeds 2 --for 1e6 --jobs 2 --out inner/sweep.sqlite --quiet 2>/dev/null & runs=$!
soon shares $runs; verdict "  except for memory, which concurrent runs share" $?
kill $runs; wait $runs
says "a run of a sweep that uses up its processor time is stored as failed, with the reason" 1 \
    "large.yaml, seed 1 failed: it took the processor time that its process may" \
    prlimit --cpu=6 "$program" sweep inner/large.yaml --seeds 1 --for 1e6 --out inner/late.sqlite
"$program" compare inner/large.yaml scenes/s.yaml --seeds 1 --for 1e6 --jobs 1 --out inner/compared --quiet >/dev/null 2>&1 & runs=$!
bounded "a comparison has its limits" $runs
alike "  and each of its runs has the same" $runs
kill $runs; wait $runs
"$program" sweep inner/large.yaml --seeds 1 --for 1e6 --jobs 1 --out inner/trusted.sqlite --quiet --trusted 2>/dev/null & runs=$!
alike "  with --trusted its runs have the limits" $runs
[ "$(limits_of $runs)" = "$(limits_of $$)" ]; verdict "  of the calling process" $?
kill $runs; wait $runs
[ "$(sqlite3 inner/large.sqlite 'PRAGMA integrity_check')" = ok ] && [ "$(sqlite3 inner/large.sqlite 'SELECT max(frame) > 100 FROM trajectory_data')" = 1 ]
verdict "  and leaves a whole recording" $?
says "resume writes below the working folder" 0 "" "$program" resume inner/deep/kept --quiet --for 4
says "confined, a recording is measured, its pictures drawn by gnuplot" 0 "" "$program" report r.sqlite --scene scenes/s.yaml --out new/report
[ -s new/report/index.html ] && ls new/report/*.png >out; verdict "  into a new folder" $?
sqlite3 unsorted.sqlite "CREATE TABLE metadata(key TEXT, value TEXT); INSERT INTO metadata VALUES('version', '2'), ('fps', '10');
    CREATE TABLE trajectory_data(frame INTEGER, id INTEGER, pos_x REAL, pos_y REAL, ori_x REAL, ori_y REAL);
    WITH RECURSIVE n(k) AS (SELECT 0 UNION ALL SELECT k + 1 FROM n WHERE k < 79999)
    INSERT INTO trajectory_data SELECT 400 - k % 400, k / 400, k / 400 % 20, k / 400 / 20, 1, 0 FROM n"
says "a long recording without an index is sorted" 0 "" "$program" report unsorted.sqlite --summary sorted.json
says "render, confined, draws a recording" 0 "" "$program" render r.sqlite --out new/one.svg --quiet
says "render, confined, draws a scene" 0 "" "$program" render scenes/s.yaml --at 1 --out two.svg --quiet
says "mod list, confined, lists a mod with its errors" 3 "this mod lacks" "$program" mod list scenes/s.yaml

# ---- a behaviour that is never read to its end, as its scene raises the limits ----
echo 'while true do end' >behaviours/endless.lua
scene endless.lua 'limits: {load_instructions: 1e9}
'
says "reading that would never end is ended, and the file named" 3 "behaviours/endless.lua: error: reading this scene takes more" \
    bash -c 'ulimit -t 1; exec "$0" run scenes/s.yaml --quiet --steps 2' "$program"
says "  with the processor time that it had" 3 "processor time than it may (1 s)" \
    bash -c 'ulimit -t 1; exec "$0" run scenes/s.yaml --quiet --steps 2' "$program"
ends() { # NAME SIGNAL TEXT: sends a signal to the process that reads the scene, and checks the message
    "$program" run scenes/s.yaml --quiet --steps 2 >out 2>&1 & run=$!
    for _ in $(seq 100); do child=$(pgrep -P $run) && break; sleep 0.05; done; sleep 0.3
    kill -s "$2" "$child"; wait $run
    local got=$?
    [ $got = 3 ] && grep -qF "behaviours/endless.lua: error: reading this scene $3" out; verdict "$1" $?
}
ends "a killed reader is not reported as slow" KILL "was ended from outside"
ends "a reader that makes a forbidden call is not reported as slow" SYS "tried to start a program"
ends "a reader that crashes is not reported as slow" ABRT "broke the process that read it (Aborted)"
echo 'local t = {} for i = 1, 1e9 do t[i] = ("x"):rep(1e6) .. i end' >behaviours/greedy.lua
scene greedy.lua 'limits: {load_instructions: 1e9, memory: 1024, block: 1024}
'
if (ulimit -v 400000; "$program" --version) >out 2>&1; then # sanitised builds need terabytes of address space
    says "a reader that runs out of memory is reported as such" 3 "takes more memory than there is" \
        bash -c 'ulimit -v 400000; exec "$0" run scenes/s.yaml --quiet --steps 2' "$program"
fi

# ---- the run uses the bytes that were vetted ----
scene near.lua
vetted=$("$program" run scenes/s.yaml --quiet --steps 20 --summary - | grep '"hash"')
trusted=$("$program" run scenes/s.yaml --quiet --steps 20 --summary - --trusted | grep '"hash"')
[ -n "$vetted" ] && [ "$vetted" = "$trusted" ]; verdict "a run has one hash, vetted or with --trusted" $?

# ---- files saved during a run are read by such a process too, while the run goes on ----
await() { for _ in $(seq 300); do grep -qF -- "$1" said && return 0; sleep 0.1; done; head -5 said; return 1; } # TEXT: waits until the run has printed a text
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
    await "edited.lua: reading this file broke the process that read it (Aborted)"; verdict "$kind:   and a crash of that process is reported" $?
    echo "-- good again
$rest" >behaviours/edited.lua
    await "reload 1 is live"; verdict "$kind:   and the next saved version replaces the old one" $?
    grep -qF -- "-- good again" log; verdict "$kind:   from the bytes that the process read" $?
    echo "while true do end $rest" >behaviours/edited.lua
    reader; began=$(date +%s%N); kill -INT $run; wait $run; status=$?
    [ $(($(date +%s%N) - began)) -lt 8000000000 ] && { [ $status = 130 ] || [ $kind != --watch ]; }; verdict "$kind: a run can be ended while a file is being read (status $status)" $?
    sleep 0.2; [ ! -e "/proc/$child" ]; verdict "$kind:   and leaves no process behind" $?
done
if ! "$program" --version | grep -q "no Landlock"; then
    echo "$rest" >behaviours/edited.lua
    "$program" run scenes/s.yaml --quiet --for 1e6 --watch --log-input log >said 2>&1 & run=$!
    begun
    printf 'jostle: 1\nlimits: {load_instructions: 1e9}\nwalls: [{file: %s/elsewhere/plan.wkt}]\ngroups: {g: {behaviour: edited.lua, at: [[0, 0]]}}\n' "$PWD" >scenes/s.yaml
    await "plan.wkt"; verdict "a saved scene cannot read other folders" $?
    kill -INT $run; wait $run
fi
exit 0 # the status of a process that was ended by a signal is no result
