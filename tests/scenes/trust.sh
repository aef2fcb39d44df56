# Files that could hang or break a run or reveal other files; runs that are ended or cannot write: errors, and nothing lost.
. tests/scenes/lib.sh
program=$(case $JOSTLE in /*) echo "$JOSTLE" ;; *) echo "$PWD/$JOSTLE" ;; esac)
scene=$PWD/scenes/running-through.yaml
cd "$work" || exit 1
says() { # NAME STATUS TEXT COMMAND...: checks exit status and a text in the output; kills a command that hangs
    local name=$1 status=$2 text=$3; shift 3
    timeout -s KILL 20 "$@" >out 2>&1 </dev/null
    local got=$?
    if [ $got = "$status" ] && grep -qF -- "$text" out; then echo "ok $name"; else
        echo "not ok $name: status $got, wanted $status and '$text'"; head -5 out; fi
}
group='groups: {g: {behaviour: stander.lua, at: [[0, 0]]}}'

# ---- pipes in place of files ----
mkfifo pipe.yaml pipe.wkt pipe.lua pipe.log pipe.sqlite
says "a pipe in place of a scene is refused" 3 "it is no regular file" "$program" run pipe.yaml --quiet
printf 'jostle: 1\ninclude: pipe.yaml\n%s\n' "$group" >s.yaml
says "a pipe in place of an included scene is refused" 3 "it is no regular file" "$program" run s.yaml --quiet
printf 'jostle: 1\nwalls: [{file: pipe.wkt}]\n%s\n' "$group" >s.yaml
says "a pipe in place of a wall file is refused" 3 "it is no regular file" "$program" run s.yaml --quiet
says "a pipe in place of an input log is refused" 3 "it is no regular file" "$program" run "$scene" --quiet --input pipe.log
says "a pipe in place of an input log to write is refused" 1 "a pipe that nobody reads" "$program" run "$scene" --quiet --log-input pipe.log
says "a pipe in place of a recording is refused" 3 "it is no regular file" "$program" report pipe.sqlite --summary -
says "a pipe in place of a recording to write is refused" 1 "not a recording" "$program" run "$scene" --quiet --record pipe.sqlite
says "a pipe in place of a summary to write is refused" 1 "a pipe that nobody reads" "$program" run "$scene" --quiet --steps 2 --summary pipe.log

# ---- files whose content a scene must not reveal ----
mkdir -p secret own
printf 'root: xyzzy\n' >secret/a.yaml
ln -s ../secret/a.yaml own/link.yaml
for name in "$work/secret/a.yaml" ../secret/a.yaml link.yaml; do
    printf 'jostle: 1\ninclude: %s\n%s\n' "$name" "$group" >own/s.yaml
    says "a scene includes nothing from outside its folder ($(basename "$(dirname "$name")")/$(basename "$name"))" 3 "lies outside the folder" "$program" check own/s.yaml
    ! grep -q xyzzy out; verdict "  and no output shows it" $?
    printf 'jostle: 1\nwalls: [{file: %s}]\n%s\n' "$name" "$group" >own/s.yaml
    says "  nor takes walls from there" 3 "lies outside the folder" "$program" check own/s.yaml
done

# ---- scenes that are too large with their includes ----
for part in one two; do { printf 'title: [1'; yes ,1 | head -300000 | tr -d '\n'; echo ']'; } >large-$part.yaml; done
printf 'jostle: 1\ninclude: [large-one.yaml]\ntitle: one\n%s\n' "$group" >s.yaml
cp "$(dirname "$scene")/../behaviours/stander.lua" .
says "a scene that is too large with its includes is refused" 0 "nothing wrong" "$program" check s.yaml
printf 'jostle: 1\ninclude: [large-one.yaml, large-two.yaml]\ntitle: one\n%s\n' "$group" >s.yaml
says "  by the limit of their total size" 3 "too large, with the files that it includes" "$program" check s.yaml

# ---- hostile recordings ----
table='CREATE TABLE metadata(key TEXT, value TEXT); INSERT INTO metadata VALUES ("fps", "10"); CREATE TABLE'
columns='(frame INTEGER, id INTEGER, pos_x REAL, pos_y REAL)'
sqlite3 view.sqlite "CREATE VIEW trajectory_data AS WITH RECURSIVE c(frame) AS (SELECT 0 UNION ALL SELECT frame + 1 FROM c) SELECT frame, 1 AS id, 0.0 AS pos_x, 0.0 AS pos_y FROM c"
says "a view in place of a table is refused" 3 "views of a file are not run" "$program" report view.sqlite --summary -
sqlite3 slow.sqlite "$table trajectory_data$columns; WITH RECURSIVE c(n) AS (SELECT 0 UNION ALL SELECT n + 1 FROM c WHERE n < 60000)
    INSERT INTO trajectory_data SELECT n, 1, 0.0, 0.0 FROM c; CREATE INDEX i ON trajectory_data(frame) WHERE frame < 0"
says "an index on an expression is not used" 3 "interrupted" "$program" report slow.sqlite --summary -
# Objects in place of a table, for each command that reads one.
kept="metadata(key, value); INSERT INTO metadata VALUES ('fps', '10'); CREATE TABLE geometry(hash INTEGER, wkt TEXT)"
sqlite3 virtual.sqlite "CREATE TABLE $kept; CREATE VIRTUAL TABLE trajectory_data USING fts5(frame, id, pos_x, pos_y)"
sqlite3 computed.sqlite "CREATE TABLE $kept; CREATE TABLE trajectory_data(frame, id, pos_x, pos_y, t AS (hex(zeroblob(frame))))"
for kind in virtual computed; do
    for reader in "report --summary -" "render --out o.svg" "view --port 8791" "compare --out compared"; do
        set -- $reader; command=$1; shift
        says "a recording whose table is $kind is refused by $command" 3 "into a plain table" "$program" $command $kind.sqlite $([ "$command" = compare ] && echo slow.sqlite) "$@"
    done
done
sqlite3 plan.sqlite "CREATE VIRTUAL TABLE geometry USING fts5(wkt); INSERT INTO geometry VALUES ('POLYGON ((0 0, 9 0, 9 9, 0 0))')"
printf 'jostle: 1\nwalls: [{file: plan.sqlite}]\n%s\n' "$group" >plan.yaml
says "walls from a virtual table are refused" 3 "'geometry' is a virtual table" "$program" check plan.yaml
says "  also with --trusted" 3 "'geometry' is a virtual table" "$program" run plan.yaml --quiet --trusted
sqlite3 runs.sqlite "PRAGMA application_id = 1246984048; PRAGMA user_version = 1; CREATE VIRTUAL TABLE sweep USING fts5(key, value); CREATE TABLE run(variant, seed, state)"
says "a sweep's file with one is refused" 3 "'sweep' is a virtual table" "$program" compare runs.sqlite runs.sqlite --out compared
says "  also for --merge" 3 "'sweep' is a virtual table" "$program" sweep --merge runs.sqlite --out merged.sqlite
says "  or when it is continued" 3 "'sweep' is a virtual table" "$program" sweep "$scene" --steps 2 --seeds 1 --out runs.sqlite
sqlite3 more.sqlite "CREATE TABLE $kept; CREATE TABLE trajectory_data$columns; INSERT INTO trajectory_data VALUES (0, 1, 1, 1), (1, 1, 1, 1); CREATE INDEX i ON trajectory_data(frame);
    CREATE VIRTUAL TABLE notes USING fts5(text); CREATE TABLE more(a, b AS (a + 1)); CREATE VIEW v AS SELECT * FROM more; CREATE TRIGGER g AFTER INSERT ON more BEGIN DELETE FROM more; END"
says "other objects beside the tables of a recording do no harm" 0 '"people": 1' "$program" report more.sqlite --summary -
for value in NULL "'here'" "x'00'"; do
    rm -f bad.sqlite
    sqlite3 bad.sqlite "$table trajectory_data(frame, id, pos_x, pos_y); INSERT INTO trajectory_data VALUES (0, 1, 1.0, 1.0), (1, 1, $value, 1.0)"
    says "a position that is $value is refused" 3 "in frame 1 a person's id or position is not a number" "$program" report bad.sqlite --summary -
done

# ---- outputs ----
says "an empty recording name is refused" 2 "needs a value" "$program" run "$scene" --quiet --record ''
says "a summary that is a folder is refused before the run" 1 "Is a directory" "$program" run "$scene" --quiet --for 1e6 --summary own
says "a report that is a file is refused before the run" 1 "it is no folder" "$program" run "$scene" --quiet --for 1e6 --report s.yaml
says "a path that a checkpoint cannot store is refused" 2 "no line breaks" "$program" run "$scene" --quiet --for 1e6 --checkpoint 1 --checkpoint-dir notes --record "a
log b"
says "a recording in a missing folder is an error" 1 "cannot record" "$program" run "$scene" --quiet --for 1e6 --record none/r.sqlite
says "a full disk as standard output is an error" 1 "cannot write to standard output: No space" sh -c "'$program' run '$scene' --quiet --steps 2 --summary - >/dev/full"
(sleep 0.3; "$program" run "$scene" --steps 2 --summary - --record closed.sqlite; echo $? >status) 2>closed.err | true
grep -q '^1$' status && grep -q 'Broken pipe' closed.err && [ "$(sqlite3 closed.sqlite 'PRAGMA integrity_check')" = ok ]
verdict "a closed pipe gives status 1 and a whole recording" $?
# Text for people may be left unread (status 0); data may not, and a full disk is an error.
cp "$scene" read.yaml
for command in --help --version "run --help" "bench --help" reference "reference scenes" "check --reference" "check read.yaml" "mod list"; do
    (sleep 0.1; "$program" $command; echo $? >status) 2>closed.err | true
    grep -q '^0$' status && [ ! -s closed.err ]; verdict "jostle $command | head -1: status 0" $?
    says "  to a full disk: status 1" 1 "cannot write to standard output: No space" sh -c "'$program' $command >/dev/full"
done
(sleep 0.1; "$program" check read.yaml --json; echo $? >status) 2>closed.err | true
grep -q '^1$' status && grep -q 'Broken pipe' closed.err; verdict "check --json to a closed pipe: status 1" $?
echo 'jostle: 2' >wrong.yaml
(sleep 0.1; "$program" check wrong.yaml; echo $? >status) 2>closed.err | true
grep -q '^3$' status; verdict "check of a wrong scene, unread: status 3" $?
sqlite3 foreign.sqlite "$table trajectory_data$columns"
says "another program's recording is not replaced" 1 "is not a recording of Jostle's" "$program" run "$scene" --quiet --record foreign.sqlite
(ulimit -f 1000; exec "$program" run "$scene" --quiet --for 1e6 --record full.sqlite) >out 2>&1
[ $? = 1 ] && grep -q 'recording failed' out && [ "$(sqlite3 full.sqlite 'PRAGMA integrity_check')" = ok ]
verdict "a full disk gives status 1, and the recording so far is whole" $?

(ulimit -n 6; exec "$program" run "$scene" --quiet --steps 2 --record few.sqlite) >out 2>&1
[ $? = 1 ] && grep -q 'cannot record to' out && [ -z "$(ls few.* 2>/dev/null)" ]
verdict "a recording that cannot be started for lack of file handles leaves no file" $?

# ---- two runs, and signals ----
"$program" run "$scene" --quiet --for 1e6 --record two.sqlite --log-input two.log --data two --summary two.json 2>err & pid=$!
for _ in $(seq 100); do [ -s two.log ] && [ -d two ] && break; sleep 0.1; done
says "a second run on the same recording is refused" 1 "another run writes it" "$program" run "$scene" --quiet --steps 2 --record two.sqlite
says "  on the same input log" 1 "another run writes it" "$program" run "$scene" --quiet --steps 2 --log-input two.log
says "  on the same folder" 1 "another run writes it" "$program" run "$scene" --quiet --steps 2 --data two
kill -TERM $pid; wait $pid
[ $? = 143 ] && [ -s two/danger.csv ] && grep -q '"hash"' two.json && [ "$(sqlite3 two.sqlite 'PRAGMA integrity_check; PRAGMA journal_mode')" = "ok
delete" ]
verdict "SIGTERM: status 143; recording, figures and summary are whole" $?
[ -z "$(find . -name '*.part')" ]; verdict "no half-written file is left" $?
env --default-signal=HUP "$program" run "$scene" --quiet --for 1e6 --record hung.sqlite --summary hung.json & pid=$!
for _ in $(seq 100); do [ -s hung.sqlite ] && break; sleep 0.1; done
sleep 0.3; kill -HUP $pid; wait $pid
[ $? = 129 ] && grep -q '"hash"' hung.json && [ "$(sqlite3 hung.sqlite 'PRAGMA integrity_check; PRAGMA journal_mode')" = "ok
delete" ]
verdict "SIGHUP (a closed terminal): status 129, and all files are whole" $?
sh -c 'trap "" HUP; exec "$@"' sh "$program" run "$scene" --quiet --for 1e6 --summary nohup.json & pid=$!
sleep 1; kill -HUP $pid; sleep 0.5; kill -TERM $pid; wait $pid
[ $? = 143 ]; verdict "  nohup prevents it" $?
for lost in lost.sqlite lost.log; do
    "$program" run "$scene" --quiet --for 1e6 --record lost.sqlite --log-input lost.log 2>err & pid=$!
    for _ in $(seq 100); do [ -s lost.sqlite ] && [ -s lost.log ] && break; sleep 0.1; done
    rm -f $lost*; sleep 0.2; kill -TERM $pid; wait $pid
    [ $? = 1 ] && grep -q 'removed or replaced' err; verdict "$lost, removed while it is written: status 1" $?
    rm -f lost.*
done

# ---- outputs over inputs, over each other, and through symbolic links ----
printf 'jostle: 1\ngroups: {g: {behaviour: own.lua, at: [[0, 0]]}}\n' >mine.yaml
echo 'return machine { name = "m", start = "S", states = { S = { steer = hold } } }' >own.lua
cp mine.yaml mine.kept; cp own.lua own.kept
says "an input log over the scene is refused" 2 "'mine.yaml' is read for this" "$program" run mine.yaml --quiet --steps 2 --log-input mine.yaml
says "a summary over a behaviour is refused" 2 "'./own.lua' is read for this" "$program" run mine.yaml --quiet --steps 2 --summary ./own.lua
says "a summary over an input log is refused" 2 "'one' is to be written twice" "$program" run mine.yaml --quiet --steps 2 --log-input one --summary one
says "a table of a sweep over its scene is refused" 2 "'mine.yaml' is read for this" "$program" sweep mine.yaml --steps 2 --out many.sqlite --csv mine.yaml
cmp -s mine.yaml mine.kept && cmp -s own.lua own.kept && [ ! -e one ]; verdict "  the files are left unchanged" $?
"$program" run mine.yaml --quiet --steps 4 --record mine.sqlite; verdict "a run is recorded for the next test" $?
says "a summary over the report's recording is refused" 2 "'mine' is read for this" sh -c "cp mine.sqlite mine; exec '$program' report mine --summary mine"
[ "$(sqlite3 mine 'PRAGMA integrity_check')" = ok ]; verdict "  the recording is left unchanged" $?
echo kept >elsewhere.txt; ln -s elsewhere.txt sum.json.part
says "a symbolic link in place of a partial file" 1 "sum.json" "$program" run mine.yaml --quiet --steps 2 --summary sum.json
[ "$(cat elsewhere.txt)" = kept ]; verdict "  is not followed" $?
mkfifo pipe2.sqlite
says "a pipe in place of a recording or a sweep's file is refused" 3 "it is no regular file" "$program" report pipe2.sqlite --out page

# ---- scenes that would take all memory or time ----
{ echo 'jostle: 1'; echo 'walls:'; for i in $(seq 300); do echo "  - {line: [[$i, -9000], [$i.5, 9000]]}"; done; echo "$group"; } >s.yaml
says "walls of too great a total length are refused" 3 "walls are over 2000 km long" "$program" run s.yaml --quiet --steps 2
{ echo 'jostle: 1'; echo "$group"; echo 'events:'; seq -f '  - {at: 1, signal: s%.0f}' 60000; } >s.yaml
timeout 120 prlimit --cpu=$((8 * ${SLOWER:-1})) "$program" run s.yaml --quiet --steps 2 >out 2>&1; verdict "tens of thousands of signals load in time" $?
awk 'BEGIN {printf "POLYGON (("; for (i = 0; i <= 100000; i++) {a = i % 100000 * 6.283185307179586 / 100000; printf "%s%.4f %.4f", i ? ", " : "", 100 * cos(a), 100 * sin(a)}; print "))"}' >round.wkt
printf 'jostle: 1\nwalls: [{file: round.wkt}]\nbodies: [{shape: {sphere: {radius: 0.2}}, at: [0, 0, 0.2], mass: 1}]\n%s\n' "$group" >s.yaml
timeout 120 prlimit --cpu=$((15 * ${SLOWER:-1})) "$program" run s.yaml --quiet --steps 2 >out 2>&1; verdict "a body among walls of 100,000 corners loads in time" $?
