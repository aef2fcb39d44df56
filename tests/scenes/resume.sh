# Resuming from checkpoints: the run continues to the same hash in another process, with other numbers of threads and
# instruction sets, in the same files, from the texts that the checkpoint holds.
. tests/scenes/lib.sh
program=$(case $JOSTLE in /*) echo "$JOSTLE" ;; *) echo "$PWD/$JOSTLE" ;; esac)
export MALLOC_PERTURB_=165 # memory that is read before it is written differs from run to run
hash() { figure hash <"$1"; }

# ---- the same hash at several ends ----
# goes_on NAME SCENE EVERY "END..." ARGS...: resumes from one checkpoint to several ends, and compares hashes
goes_on() {
    local name=$1 scene=$2 every=$3 ends=$4 end way=0; shift 4
    for end in $ends; do
        rm -rf "$work/ck" "$work/whole.json" "$work/rest.json"
        "$program" run "$scene" --quiet --for "$end" --checkpoint "$every" --checkpoint-dir "$work/ck" --summary "$work/whole.json" "$@" 2>"$work/err"
        way=$((way + 1))
        "$program" resume "$work/ck/latest.checkpoint" --quiet --threads $((1 + way % 3)) --isa "$([ $way = 1 ] && echo scalar || echo sse2)" --summary "$work/rest.json" 2>>"$work/err"
        same_hash "$name goes on to $end s" "$(hash "$work/whole.json")" "$(hash "$work/rest.json")"
        [ "$(figure steps <"$work/rest.json")" = "$(figure steps <"$work/whole.json")" ] || echo "not ok $name: other steps"
    done
}
goes_on "a crowd that pushes" scenes/running-through.yaml 3 "3.05 4 9"
goes_on "bodies, thrown and kicked" scenes/dodgeball.yaml 7 "13 16 20"
goes_on "a wall that breaks" scenes/wall-breaking.yaml 1 "6.5 8"
goes_on "people who come and go" scenes/tawaf.yaml 2 "3.5" --set groups.pilgrims.count=1000
goes_on "doors upon their paths" scenes/train-doors.yaml 2 "9.6 14.5"
goes_on "events and gates" scenes/gates.yaml 4 "9"
goes_on "messages that wait, and whom people hold" scenes/drill.yaml 8 "32 54 71"
goes_on "whom people chase, and where they saw them" scenes/pickpocket.yaml 3 "6 19"
cat >"$work/teller.lua" <<'END'
-- Names of messages that functions make up, and of their values.
local mine = memory { sum = 0, met = list(4, nobody), last = nobody }
return machine { name = "teller", version = 1, start = "Walk", defaults = { perception = 9 }, states = {
  Walk = { steer = wander(),
    { every = 0.4, when = sees(nearest "anyone"), on_take = function(me)
        local name = "call" .. math.random(5)
        me.tell(me.neighbours[1], name, { ["value" .. math.random(3)] = me.x, who = me.neighbours[2] })
      end },
    { every = 3, set = { met = mine.met:push(nearest "anyone"), last = best("anyone", other.speed) },
      on_take = function(me)
        local call = me.told("call" .. math.random(5))
        if call then me.sum = me.sum + (call.value1 or 0) + (call.value2 or 0) + 1 end
      end } } } }
END
printf 'jostle: 1\nplaces: {yard: {polygon: [[0, 0], [9, 0], [9, 9], [0, 9]]}}\nwalls: [{line: [[0, 0], [9, 0], [9, 9], [0, 9]], closed: true}]\ngroups: {g: {behaviour: teller.lua, count: 20, fill: random, in: yard}}\n' >"$work/teller.yaml"
goes_on "messages whose names functions make up" "$work/teller.yaml" 2 "4.3 9"
# A reload that names messages in another order, while some wait.
mkdir -p "$work/order"
cat >"$work/order/ear.lua" <<'END'
local mine = memory { n = 0, c = 0 }
local hi, ho = told "hi", told "ho"
return machine { name = "ear", version = 1, start = "Wait", defaults = { perception = 9 }, states = {
  Wait = { steer = hold, { to = "Hear", when = after(5) } },
  Hear = { steer = hold,
    { when = hi, set = { n = mine.n + hi.v } },
    { every = 1, when = ho, set = { c = 2 * mine.c + ho.v } } } } }
END
cat >"$work/order/mouth.lua" <<'END'
return machine { name = "mouth", start = "Talk", defaults = { perception = 9 }, states = { Talk = { steer = hold,
  { every = 0.5, tell = { nearest "ears", "hi", v = now.time } },
  { every = 0.5, tell = { nearest "ears", "ho", v = now.time } } } } }
END
printf 'jostle: 1\ngroups:\n  ears: {behaviour: ear.lua, at: [[0, 0]], tags: [ears]}\n  mouths: {behaviour: mouth.lua, at: [[2, 0]]}\n' >"$work/order/scene.yaml"
sed 's/local hi, ho = told "hi", told "ho"/local hum, ho, hi = told "hum", told "ho", told "hi"/; s/when = ho, set/when = ho | hum, set/' "$work/order/ear.lua" >"$work/order/new.lua"
{ printf '60 files 1\norder/ear.lua %s\n' "$(wc -c <"$work/order/new.lua")"; cat "$work/order/new.lua"; echo; } >"$work/order/input"
there=$PWD
cd "$work" # an input log names files as the run does
goes_on "messages that wait over a reload of other names" order/scene.yaml 3.5 "8 12" --input order/input
cd "$there"
goes_on "a mod" scenes/tawaf.yaml 1 "2.5" --set groups.pilgrims.count=300 --mod scenes/mods/rough

# ---- from the texts that it holds, anywhere ----
tree=$work/tree
mkdir -p "$tree"
cp scenes/running-through.yaml "$tree/scene.yaml"
cp behaviours/*.lua "$tree/"
rm -f "$work/whole.json" "$work/rest.json"
(cd "$tree" && "$program" run scene.yaml --quiet --for 6 --checkpoint 3 --checkpoint-dir "$work/texts" --summary "$work/whole.json")
echo 'nonsense: [' >"$tree/scene.yaml"; rm -f "$tree"/*.lua
"$program" resume "$work/texts" --quiet --summary "$work/rest.json"
same_hash "resuming does not depend on later edits, nor on the working folder" "$(hash "$work/whole.json")" "$(hash "$work/rest.json")"

# ---- behaviours that were reloaded, and input that was played, before and after ----
mkdir -p "$work/live"
cp behaviours/stander.lua "$work/live/live.lua"
printf 'jostle: 1\nplaces: {yard: {polygon: [[0, 0], [9, 0], [9, 9], [0, 9]]}}\ngroups: {g: {behaviour: live.lua, count: 120, fill: random, in: yard}}\n' >"$work/live/scene.yaml"
cat >"$work/live/played" <<'END'
20 push 3 400 0
45 set stander defaults perception 2.5
90 push 4 0 300
130 set stander defaults perception 1
END
(cd "$work/live" && "$program" run scene.yaml --quiet --steps 200 --input played --log-input log --checkpoint 5 --checkpoint-dir ck --summary whole.json && cp log whole.log &&
    "$program" resume ck/before.checkpoint --quiet --summary rest.json) 2>"$work/err" || cat "$work/err"
same_hash "a played input log continues after resuming" "$(hash "$work/live/whole.json")" "$(hash "$work/live/rest.json")"
cmp -s "$work/live/log" "$work/live/whole.log"; verdict "  and the written log is the same, byte by byte" $?
(cd "$work/live" && exec "$program" run scene.yaml --quiet --steps 900000000 --watch --log-input log --checkpoint 5 --checkpoint-dir reloaded) 2>"$work/live/said" & pid=$!
for _ in $(seq 100); do [ -s "$work/live/reloaded/before.checkpoint" ] && break; sleep 0.1; done
sed -i 's/perception = 1.5/perception = 2.5/' "$work/live/live.lua"
for _ in $(seq 100); do grep -q 'version 1 (reload 1) is live' "$work/live/said" && break; sleep 0.1; done
sleep 0.5; kill -KILL $pid; wait $pid 2>/dev/null
sed -i 's/perception = 2.5/perception = 0.5/' "$work/live/live.lua"
cp "$work/live/log" "$work/live/until"; rm -f "$work/live/whole.json" "$work/live/rest.json"
(cd "$work/live" && tick=$("$program" resume reloaded --for 0 2>&1 | sed -n 's/^resumed at \([0-9.]*\) s$/\1/p') &&
    end=$(awk -v t="$tick" 'BEGIN {print t + 5}') && cp until log && "$program" resume reloaded --quiet --for "$end" --summary rest.json &&
    "$program" run scene.yaml --quiet --for "$end" --input until --checkpoint 1e6 --checkpoint-dir none --summary whole.json) 2>"$work/err"
same_hash "a reloaded behaviour continues in its version of that time" "$(hash "$work/live/whole.json")" "$(hash "$work/live/rest.json")"

# ---- reports and data, with all that probes, maps and figures have collected ----
# same_files NAME OPTION SCENE UNTIL END ARGS...: a run to END, and one to UNTIL that goes on to END from its last checkpoint
same_files() {
    local name=$1 option=$2 scene=$3 until=$4 end=$5; shift 5
    rm -rf "$work/whole" "$work/rest" "$work/ck"; mkdir -p "$work/whole" "$work/rest"
    run() { (cd "$work/$1" && "$program" run "$tree/$scene" --quiet --for "$2" "$option" out --checkpoint 1 --checkpoint-dir ck --summary summary.json "${@:3}"); }
    run whole "$end" "$@" >"$work/err" 2>&1 && run rest "$until" "$@" >"$work/err" 2>&1 &&
        (cd "$work/rest" && rm -rf out summary.json && "$program" resume ck --quiet --for "$end" --summary summary.json --threads 2) >"$work/err" 2>&1
    diff -r "$work/whole/out" "$work/rest/out" >"$work/differ" && [ "$(ls "$work/rest/out" | wc -l)" -gt 5 ] &&
        diff <(grep -v 'wall_s\|cpu_s\|resumed_s\|steps_per_s\|_ns\|ns_per\|"[a-z]*": [0-9.e+]*,\?$' "$work/whole/summary.json") \
            <(grep -v 'wall_s\|cpu_s\|resumed_s\|steps_per_s\|_ns\|ns_per\|"[a-z]*": [0-9.e+]*,\?$' "$work/rest/summary.json") >>"$work/differ"
    verdict "$name, byte by byte" $? || head -5 "$work/err" "$work/differ"
}
tree=$work/probed
mkdir -p "$tree"
cp -r scenes behaviours "$tree/"
sed -i 's/^probes:/probes:\n  swirl: {oscillation: {area: [[-2, -2], [4, 2]], span: 2}, every: 0.1}/' "$tree/scenes/running-through.yaml"
cat >>"$tree/scenes/station.yaml" <<'SCENE'
report: {author: A. Engineer, date: 2026-05-04}
criteria: {dense: {density: 2, at: car, lasting: 9}, pressed: {load: 6000}}
SCENE
same_files "a report of bodies, with a log of what was done to them, goes on" --report scenes/dodgeball.yaml 7 11
same_files "a report with maps, areas and criteria goes on" --report scenes/station.yaml 5 9
same_files "data of displacements, failures, transits and oscillations go on" --data scenes/running-through.yaml 3 8
same_files "data of bodies go on" --data scenes/office.yaml 7 12 --set groups.people.count=100
same_files "data of winding ways go on" --data scenes/tawaf-few.yaml 4 9
same_files "data of lanes go on" --data scenes/counter-rooms.yaml 4 9
same_files "data of visits go on" --data scenes/premovement.yaml 15 30
same_files "data of single file go on" --data scenes/ring.yaml 4 9
same_files "data of regions, and of people who come and go, go on" --data scenes/tawaf.yaml 5 9 --set groups.pilgrims.count=600 --set sources.0.keep=600

# ---- what cannot be resumed ----
refused() { # NAME TEXT FILE
    "$program" resume "$3" --quiet >"$work/out" 2>&1
    [ $? = 3 ] && grep -qF "$2" "$work/out"; verdict "$1" $?
}
file=$work/texts/latest.checkpoint size=$(stat -c %s "$work/texts/latest.checkpoint")
refused "no checkpoint at all" "it is no checkpoint" scenes/circle.yaml
refused "none there" "No such file" "$work/none.checkpoint"
head -c $((size - 1)) "$file" >"$work/cut"; refused "one that is cut short by a byte" "cut short" "$work/cut"
head -c 300 "$file" >"$work/cut"; refused "  or after the first piece" "cut short" "$work/cut"
sed 's/jostle checkpoint 1/jostle checkpoint 9/' "$file" >"$work/other"; refused "another format" "of another format" "$work/other"
cp "$file" "$work/bad"; printf 'X' | dd of="$work/bad" bs=1 seek=$((size - 5000)) conv=notrunc 2>/dev/null
refused "a byte that is another" "is damaged: its checksum does not match" "$work/bad"
cp "$work/bad" "$work/texts/latest.checkpoint"
"$program" resume "$work/texts" --quiet >"$work/out" 2>&1 && grep -q 'the one before it is taken' "$work/out"
verdict "if the newest checkpoint is damaged, the previous one is used, with a message" $?
