# jostle sweep: every combination and seed in one file, which is continued after any end, holds its inputs, and refuses
# others; the same by GNU parallel; run --seeds, which uses the same mechanism. tests/cluster has Slurm and Snakemake.
. tests/scenes/lib.sh
program=$(case $JOSTLE in /*) echo "$JOSTLE" ;; *) echo "$PWD/$JOSTLE" ;; esac)
mkdir -p "$work/project/scenes" "$work/project/behaviours"
cp scenes/evacuation.yaml "$work/project/scenes/rooms.yaml"
cp behaviours/*.lua "$work/project/behaviours/"
cd "$work/project" || exit 1
scene=scenes/rooms.yaml
what=(--set groups.hall.count=20,30 --set groups.archive.count=5 --seeds 3 --for 4)
# table FILE: prints the results of all runs, without times.
table() { "$program" sweep "$scene" "${what[@]}" --out "$1" --quiet --csv - ; }

# ---- a whole one ----
expect "a sweep runs all combinations" 0 "6 runs with figures" "$program" sweep $scene "${what[@]}" --out whole.sqlite
table whole.sqlite >whole.csv
[ "$(wc -l <whole.csv)" = 7 ] && head -1 whole.csv | grep -q '^groups.hall.count,groups.archive.count,seed,state,reason,hash,steps,simulated_s,agents,.*,density_max,'; verdict "--csv writes a row for each run" $?
[ "$(cut -d, -f1-4 whole.csv | tail -6 | tr '\n' ' ')" = "20,5,1,done 20,5,2,done 20,5,3,done 30,5,1,done 30,5,2,done 30,5,3,done " ]; verdict "the table has every combination with every seed" $?
for row in "20 2" "30 3"; do
    set -- $row
    same_hash "a run of a sweep has the hash of jostle run: $row" "$(hash_of "$program" $scene --set groups.hall.count="$1" --set groups.archive.count=5 --seed "$2" --for 4)" \
        "$(grep "^$1,5,$2," whole.csv | cut -d, -f6)"
done
[ "$(sqlite3 whole.sqlite "select count(*) from input where path = 'scenes/rooms.yaml' or path = 'behaviours/evacuee.lua'")" = 2 ] &&
    [ "$(sqlite3 whole.sqlite "select cast(text as text) from input where path = 'scenes/rooms.yaml'")" = "$(cat $scene)" ]; verdict "the file holds the texts of all inputs" $?
[ "$(sqlite3 whole.sqlite "select cast(value as integer) from figure f join variant v on v.id = f.variant where v.settings like '%hall.count=30%' and seed = 2 and name = 'danger.inside'")" -gt 0 ] &&
    [ "$(sqlite3 whole.sqlite "select count(distinct time) from curve_point natural join (select id as curve from curve_name where name = 'people inside') where variant = 1 and seed = 1")" = 41 ]; verdict "figures and curves can be queried by SQL" $?
expect "finished runs are not repeated" 0 "6 of 6 runs done (6 from before)" "$program" sweep $scene "${what[@]}" --out whole.sqlite
what=(--set groups.hall.count=20,30,40 --set groups.archive.count=5 --seeds 4 --for 4)
cp whole.sqlite more.sqlite
expect "with more seeds and values only new runs are done" 0 "12 of 12 runs done (6 from before)" "$program" sweep $scene "${what[@]}" --out more.sqlite
what=(--set groups.hall.count=20,30 --set groups.archive.count=5 --seeds 3 --for 4)

# ---- interrupted and killed ----
goes_on() { # NAME SIGNAL RUNS: ends a sweep by a signal after RUNS runs, and continues it
    local n=0 pid
    rm -f cut.sqlite*
    "$program" sweep $scene "${what[@]}" --jobs 1 --out cut.sqlite --quiet 2>err &
    pid=$!
    while kill -0 $pid 2>/dev/null && [ "${n:-0}" -lt "$3" ]; do
        sleep 0.05; n=$(sqlite3 -readonly cut.sqlite 'select count(*) from run' 2>/dev/null)
    done
    kill -"$2" $pid
    wait $pid; echo "status $?" >>err
    n=$(sqlite3 cut.sqlite 'select count(*) from run')
    table cut.sqlite >cut.csv
    [ "$n" -ge "$3" ] && [ "$n" -lt 6 ] && cmp -s cut.csv whole.csv; verdict "$1 after $n runs: the same command continues to the same table" $?
}
goes_on "killed" KILL 2
goes_on "interrupted" INT 1
grep -q 'status 130' err && grep -q 'runs are kept in cut.sqlite, and the same command continues with it' err; verdict "  and the message says what is kept" $?
[ -z "$(ps -eo ppid=,args= | awk '$1 == 1' | grep 'cut[.]sqlite')" ]; verdict "  no process is left" $?

# ---- inputs ----
echo '-- another text' >>behaviours/evacuee.lua
cp whole.sqlite changed.sqlite
expect "a changed input file is named, and the sweep refused" 3 "behaviours/evacuee.lua has changed" "$program" sweep $scene "${what[@]}" --out changed.sqlite
cmp -s whole.sqlite changed.sqlite; verdict "  and the file is left unchanged" $?
sed -i '$d' behaviours/evacuee.lua
expect "another duration is named, and the sweep refused" 3 "duration: 4 s there, 9 s now" "$program" sweep $scene "${what[@]}" --for 9 --out whole.sqlite
"$program" sweep $scene "${what[@]}" --jobs 1 --out edited.sqlite 2>err &
pid=$!
while kill -0 $pid 2>/dev/null && [ "$(sqlite3 -readonly edited.sqlite 'select count(*) from run' 2>/dev/null || echo 0)" -lt 1 ]; do sleep 0.05; done
mv $scene $scene.away; wait $pid; mv $scene.away $scene
table edited.sqlite | cmp -s - whole.csv; verdict "edits during the sweep do not affect its runs" $?

# ---- failures ----
printf 'return machine { name = "odd", start = "A", states = { A = { steer = drift(1, 0) } } }\n' >behaviours/odd.lua
printf 'jostle: 1\ngroups: {walkers: {behaviour: odd.lua, at: [[9999.5, 0], [9, 9]]}}\n' >scenes/fails.yaml
fails=(--set guard.people=end,remove --seeds 2 --for 2)
expect "failed runs are stored with their reason, and the sweep goes on" 1 "2 runs with figures, 2 of them did not go as written, 2 failed" "$program" sweep scenes/fails.yaml "${fails[@]}" --out fails.sqlite
grep -qF 'people=end, seed 2 failed: step 8, t = 0.40 s: the position of agent 0 is more than 10 km from the origin' "$work/out"; verdict "  the sweep prints the reason" $?
[ "$(sqlite3 fails.sqlite "select count(*) from run where state = 'failed' and reason like '%the position of agent 0%'")" = 2 ]; verdict "  the file holds it" $?
expect "  they are not repeated" 1 "4 of 4 runs done (4 from before, 2 failed)" "$program" sweep scenes/fails.yaml "${fails[@]}" --out fails.sqlite
expect "  with --again they are" 1 "4 of 4 runs done (2 from before, 2 failed)" "$program" sweep scenes/fails.yaml "${fails[@]}" --out fails.sqlite --again
"$program" sweep $scene --seeds 1 --for 80 --out killed.sqlite >"$work/out" 2>&1 &
pid=$!
child=
while kill -0 $pid && [ -z "$child" ]; do sleep 0.1; [ -s killed.sqlite ] && child=$(pgrep -P $pid); done
kill -KILL $child; wait $pid
grep -q 'seed 1 failed: its process was ended by signal 9' "$work/out"; verdict "a run whose process is killed counts as failed" $?

# ---- errors ----
expect "an unknown path is refused with the nearest one" 3 "Did you mean 'count'?" "$program" sweep $scene --set groups.hall.cuont=1,2 --out x.sqlite
expect "  and a variant that does not load is named" 3 "the variant count=few does not load" "$program" sweep $scene --set 'groups.hall.count=few,a lot' --out x.sqlite
[ ! -e x.sqlite ]; verdict "  and no file is made" $?
many=$(seq -s, 20000)
expect "of thousands of variants that fail alike 20 are read" 3 "the first 20 of 20000 variants do not load, all for the same reason" timeout 60 "$program" sweep $scene --set groups.hall.cuont="$many" --out x.sqlite --quiet
[ "$(grep -c 'cuont' "$work/out")" -le 20 ]; verdict "  and at most 20 reported" $?
# --foreground: else timeout sends the signal to the process and to its group, and a second signal ends it at once.
timeout --foreground -s INT 2 "$program" sweep $scene --set groups.hall.count="$many" --out x.sqlite --quiet 2>err & pid=$!
( sleep 20; kill -KILL $pid 2>/dev/null ) & guard=$!
wait $pid; kill $guard 2>/dev/null
grep -qE 'interrupted while it read the variants, [0-9]* of 20000; none was run|reading this scene was interrupted' err && [ ! -e x.sqlite ]; verdict "reading thousands of variants can be interrupted" $?
# On a terminal a line shows the progress, and is erased at the end.
python3 -c '
import os, pty, signal, sys
pid, terminal = pty.fork()
if pid == 0:
    os.execv(sys.argv[1], sys.argv[1:])
said, told = b"", False
try:
    while True:
        said += os.read(terminal, 65536)
        if b"of 20000 variants read" in said and not told:
            told = True
            os.kill(pid, signal.SIGINT)
except OSError: # its end
    pass
os.waitpid(pid, 0)
last = said.rsplit(b"variants read", 1)
sys.exit(not (len(last) == 2 and last[1].startswith(b"\r\x1b[K") and b"interrupted" in last[1]))
' "$program" sweep $scene --set groups.hall.count="$many" --out x.sqlite; verdict "  a line on a terminal shows its progress" $?
expect "a variant that does not load is stored as failed" 1 "3 runs with figures, 3 failed" "$program" sweep $scene --set 'groups.hall.count=a lot,5' --steps 1 --seeds 3 --out partly.sqlite
[ "$(sqlite3 partly.sqlite "select count(*) from run join variant on id = variant where settings like '%a lot' and state = 'failed' and reason like '%it does not load: %a lot%'")" = 3 ]; verdict "  with the reason" $?
expect "  and the others can be compared" 0 "partly: count=5" "$program" compare partly.sqlite whole.sqlite --base 2 --out partly
expect "an empty value is refused" 2 "a value of the list is empty" "$program" sweep $scene --set groups.hall.count=1,,2 --out x.sqlite
expect "a repeated value is refused" 2 "stands in the list twice" "$program" sweep $scene --set groups.hall.count=1,2,1 --out x.sqlite
"$program" sweep $scene --set 'groups.hall.set.speed=normal(1.3, 0.1),1.2' --steps 1 --out drawn.sqlite --quiet && [ "$(sqlite3 drawn.sqlite 'select count(*) from variant')" = 2 ]; verdict "a comma within brackets does not separate values" $?
expect "an open bracket is refused" 2 "not closed" "$program" sweep $scene --set 'groups.hall.set.speed=normal(1,2' --out x.sqlite
expect "a repeated path is refused" 2 "set twice" "$program" sweep $scene --set groups.hall.count=1 --set groups.hall.count=2 --out x.sqlite
expect "too many runs are refused" 2 "100000 runs are the most" "$program" sweep $scene --set groups.hall.count=1,2 --seeds 100000 --out x.sqlite
expect "--missing without --list is refused" 2 "--missing goes with --list" "$program" sweep $scene --missing --out x.sqlite
expect "a folder without files is not merged" 3 "has no file whose name ends in .sqlite" "$program" sweep --merge scenes --out x.sqlite
expect "a sweep without --out is refused" 2 "--out FILE says" "$program" sweep $scene --seeds 2
expect "a missing scene is refused" 3 "gone.yaml" "$program" sweep gone.yaml --out x.sqlite
printf 'not a database, and long enough to be looked at: %0100d' 7 >foreign.sqlite; cp foreign.sqlite kept
expect "a file that is no database is refused" 3 "no file of \`jostle sweep\`" "$program" sweep $scene "${what[@]}" --out foreign.sqlite
sqlite3 other.sqlite 'create table t(a); insert into t values(1)'; cp other.sqlite kept.sqlite
expect "another program's database is refused" 3 "left as it is" "$program" sweep $scene "${what[@]}" --out other.sqlite
cmp -s foreign.sqlite kept && cmp -s other.sqlite kept.sqlite; verdict "  both are left unchanged" $?
cp whole.sqlite damaged.sqlite; dd if=/dev/urandom of=damaged.sqlite bs=4096 seek=1 count=30 conv=notrunc 2>/dev/null
expect "a damaged file is refused" 3 "the file is damaged" "$program" sweep $scene "${what[@]}" --out damaged.sqlite
expect "a folder in place of the file is refused" 1 "no regular file" "$program" sweep $scene "${what[@]}" --out scenes
expect "a file in a missing folder is an error" 1 "cannot write 'nowhere/x.sqlite'" "$program" sweep $scene "${what[@]}" --out nowhere/x.sqlite
"$program" sweep $scene --seeds 1 --for 80 --out two.sqlite --quiet &
pid=$!
while kill -0 $pid && [ ! -s two.sqlite ]; do sleep 0.02; done
expect "a second sweep on the same file is refused" 1 "another sweep writes it" "$program" sweep $scene --seeds 1 --for 80 --out two.sqlite
kill $pid; wait $pid 2>/dev/null
(ulimit -f 400; "$program" sweep $scene "${what[@]}" --out full.sqlite >"$work/out" 2>&1; echo "status $?" >>"$work/out")
grep -q 'status 1' "$work/out" && grep -q 'finished runs are kept' "$work/out"; verdict "a full disk is an error" $?
[ "$(sqlite3 full.sqlite 'pragma integrity_check')" = ok ] && table full.sqlite | cmp -s - whole.csv; verdict "  and the sweep continues once there is room" $?

# ---- many machines ----
"$program" sweep $scene "${what[@]}" --out many.sqlite --list >jobs
[ "$(wc -l <jobs)" = 6 ] && [ ! -e many.sqlite ]; verdict "--list prints a command for each run" $?
parallel --version >/dev/null && parallel -j 2 <jobs >"$work/out" 2>&1; verdict "GNU parallel runs these" $?
[ "$(ls many-parts | wc -l)" = 6 ] && [ "$(sqlite3 many-parts/run-000005.sqlite 'select count(*), min(seed) from run')" = "1|2" ]; verdict "  each writes a file of its own" $?
mv many-parts/run-000004.sqlite fourth.sqlite
expect "--merge names a missing run" 3 "run 4: count=30, seed 1" "$program" sweep --merge many-parts --out many.sqlite
grep -qF 'nothing was merged into many.sqlite' "$work/out" && [ ! -e many.sqlite ]; verdict "  and merges nothing" $?
expect "  --status names it" 1 $'4\tmissing\tcount=30, seed 1\tmany-parts/run-000004.sqlite' "$program" sweep $scene "${what[@]}" --out many.sqlite --status
[ "$("$program" sweep $scene "${what[@]}" --out many.sqlite --list --missing)" = "$(sed -n 4p jobs)" ]; verdict "  --list --missing prints its command" $?
expect "  --partial merges the others" 1 "5 runs with figures, 1 missing" "$program" sweep --merge many-parts/*.sqlite --out many.sqlite --partial
expect "  and the sweep's command does the missing run" 0 "6 of 6 runs done (5 from before)" "$program" sweep $scene "${what[@]}" --out many.sqlite
table many.sqlite | cmp -s - whole.csv; verdict "  the table is that of one machine" $?
size=$(stat -c %s fourth.sqlite); head -c $((size / 2)) fourth.sqlite >many-parts/run-000004.sqlite
expect "half a file is not merged" 3 "the file is damaged" "$program" sweep --merge many-parts --out half.sqlite
grep -qF many-parts/run-000004.sqlite "$work/out" && [ ! -e half.sqlite ]; verdict "  nor any other" $?
mv many-parts half-parts
expect "  --status names it, and tells of the others" 3 "run 4: half-parts/run-000004.sqlite: " "$program" sweep $scene "${what[@]}" --out half.sqlite --status
grep -q $'^4\tunreadable\t' "$work/out" && [ "$(grep -c $'\tdone\t' "$work/out")" = 5 ] && grep -q '1 file cannot be read' "$work/out"; verdict "  and counts it" $?
mv half-parts many-parts
cp fourth.sqlite many-parts/run-000004.sqlite
cp fourth.sqlite other.sqlite; sqlite3 other.sqlite "update run set hash = '0123456789abcdef'"
expect "parts that disagree are not merged" 3 "the programs that made them are not the same" "$program" sweep --merge many-parts other.sqlite --out clash.sqlite
[ ! -e clash.sqlite ]; verdict "  and no file is left" $?
expect "all files are merged in a canonical file" 0 "6 runs with figures" "$program" sweep --merge many-parts/*4.sqlite many-parts --out merged.sqlite --canonical
"$program" sweep $scene "${what[@]}" --out alone.sqlite --jobs 1 --isa scalar --quiet --canonical; cmp alone.sqlite merged.sqlite; verdict "  which is that of one machine, byte for byte" $?
"$program" sweep $scene "${what[@]}" --out many.sqlite --quiet --canonical && cmp many.sqlite merged.sqlite; verdict "  and that of a sweep that was continued" $?
[ "$(sqlite3 merged.sqlite 'pragma integrity_check')" = ok ] && table merged.sqlite | cmp -s - whole.csv; verdict "  it has the results of all runs" $?
sed -n 2p jobs | sed 's/ --out .*//; s/ --for [^ ]*/ --for 10000/' >long
sh -c "exec $(cat long) --out only.sqlite" 2>"$work/out" &
pid=$!
child=
while kill -0 $pid && [ -z "$child" ]; do sleep 0.05; child=$(pgrep -P $pid); done
kill -KILL $child; wait $pid
[ $? = 1 ] && grep -q 'run 2: its process was ended by signal 9' "$work/out" && [ ! -e only.sqlite ]; verdict "of one run whose process is killed no file is left" $?
sh -c "exec $(cat long) --out only.sqlite" 2>"$work/out" &
pid=$!
child=
while kill -0 $pid && [ -z "$child" ]; do sleep 0.05; child=$(pgrep -P $pid); done
kill -TERM $child $pid; wait $pid
[ $? = 143 ] && grep -q 'nothing is stored' "$work/out" && [ -z "$(ls | grep '^only')" ]; verdict "  nor of one that a batch system cancels" $?
[ "$(sqlite3 merged.sqlite 'select count(*), sum(value) from curve_point')" = "$(sqlite3 whole.sqlite 'select count(*), sum(value) from curve_point')" ]; verdict "  and so are the curves" $?
"$program" sweep $scene --set groups.hall.count=20,30 --set groups.archive.count=6 --seeds 3 --for 7 --only 1 --out another.sqlite --quiet
expect "a file of another sweep is not merged" 3 "belongs to another sweep" "$program" sweep --merge another.sqlite --out many.sqlite
cp many-parts/run-000001.sqlite lies.sqlite; sqlite3 lies.sqlite "update run set hash = '0000000000000000'"
expect "a file with another result for a run is not merged" 3 "the programs that made them are not the same" "$program" sweep --merge lies.sqlite --out many.sqlite
expect "the merged file itself among the files is left as it is" 0 "6 runs with figures" "$program" sweep --merge many.sqlite many-parts --out many.sqlite
# odd NAME WORDS SQL...: merges a file that another program changed by SQL, which is refused by its name.
odd() {
    cp many-parts/run-000001.sqlite odd.sqlite; sqlite3 odd.sqlite "$3"
    expect "$1" 3 "odd.sqlite: $2" "$program" sweep --merge odd.sqlite --out odd-merged.sqlite
    [ ! -e odd-merged.sqlite ]; verdict "  and nothing is merged" $?
}
odd "a file without values of its settings is refused" "the file is damaged" 'create table s(key text primary key, value); insert into s select key, null from sweep; drop table sweep; alter table s rename to sweep'
odd "a file without paths of inputs is refused" "the file is damaged" 'create table i(path text, sha256, text); insert into i select null, sha256, text from input; drop table input; alter table i rename to input'
odd "a file whose plan is none is refused" "the plan of its runs cannot be read" 'update planned set seeds = 0'
odd "a file that lacks a column is refused" "no such column" 'alter table run drop column cpu_s'
expect "a name that no line can hold is not listed" 2 "cannot hold the line end" "$program" sweep $scene "${what[@]}" --out $'two\nlines.sqlite' --list

sed -i 's/^jostle: 1/jostle: 1 # edited/' $scene
expect "the state of runs of other inputs is not told" 3 "$scene has changed" "$program" sweep $scene "${what[@]}" --out many.sqlite --status
sed -i 's/^jostle: 1 # edited/jostle: 1/' $scene
# A file of the former format, which has no plans, is continued and merged.
for f in former/run-000001 former; do
    mkdir -p former; cp many-parts/run-000001.sqlite $f.sqlite
    sqlite3 $f.sqlite 'drop table planned; pragma user_version = 1'
done
expect "a file of the former format is merged" 0 "1 run with figures" "$program" sweep --merge former --out from-former.sqlite
expect "  and continued" 0 "6 of 6 runs done (1 from before)" "$program" sweep $scene "${what[@]}" --out former.sqlite --canonical
cmp former.sqlite merged.sqlite; verdict "  to the same file" $?

# ---- run --seeds ----
"$program" run $scene --set groups.hall.count=20 --set groups.archive.count=5 --seeds 3 --for 4 --quiet --summary seeds.json --data each 2>err
[ "$(grep -o '"hash": \[.*\]' seeds.json)" = "$(awk -F, '$1 == 20 {h = h (h ? ", " : "") "\"" $6 "\""} END {print "\"hash\": [" h "]"}' whole.csv)" ]; verdict "run --seeds has the hashes of a sweep" $?
[ -s each/seed-1/south.csv ] && [ -s each/seed-3/south.csv ] && ! cmp -s each/seed-1/danger.csv each/seed-3/danger.csv; verdict "  with CSV files of each seed" $?
