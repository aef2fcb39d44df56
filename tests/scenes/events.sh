# Events of scenes: the shipped scene gates, its figures and pictures, errors, and equal hashes.
. tests/scenes/lib.sh
gates=scenes/gates.yaml
count() { grep -o "\"$1\": [0-9][0-9]*" "$2" | head -1 | grep -o '[0-9]*$'; }
sql() { sqlite3 "$work/g.sqlite" "$1"; }

"$JOSTLE" run $gates --quiet --record "$work/g.sqlite" --report "$work/g" --summary "$work/g.json" 2>/dev/null
verdict "the scene gates runs" $?
between "nobody is left at the end" "$(figure agents <"$work/g.json")" 0 0
between "two gates open" "$(count opened "$work/g.json")" 2 2
between "one gate closes" "$(count closed "$work/g.json")" 1 1
between "the crate is thrown" "$(count throws "$work/g.json")" 1 1
between "the crate hits people" "$(count hits "$work/g.json")" 1 20
between "the alarm is heard by all" "$(count transitions "$work/g.json")" 270 270 # three each
# Frames are 0.1 s apart. The east gate is open from 15 s to 23 s, the south gate from 28 s on.
outside="(pos_x > 14 OR pos_y < 0)"
between "nobody is out before a gate opens" "$(sql "SELECT count(*) FROM trajectory_data WHERE frame < 150 AND $outside")" 0 0
between "many wait at the east gate" "$(sql "SELECT count(*) FROM trajectory_data WHERE frame = 148 AND pos_x > 11 AND pos_y BETWEEN 3 AND 9")" 30 60
between "many wait at the south gate" "$(sql "SELECT count(*) FROM trajectory_data WHERE frame = 148 AND pos_y < 3 AND pos_x BETWEEN 1 AND 7")" 25 60
between "hardly anybody waits in a corner" "$(sql "SELECT count(*) FROM trajectory_data WHERE frame = 148 AND (pos_x < 1 OR pos_x > 13) AND (pos_y < 1 OR pos_y > 11)")" 0 2
between "people leave by the east gate" "$(sql "SELECT count(DISTINCT id) FROM trajectory_data WHERE pos_x > 14.5")" 10 60
between "nobody passes it once it is shut" "$(sql "SELECT count(*) FROM trajectory_data a JOIN trajectory_data b ON a.id = b.id AND b.frame = a.frame + 1 WHERE a.frame > 230 AND a.pos_x < 14 AND b.pos_x > 14")" 0 0
between "the rest leave by the south gate" "$(sql "SELECT count(DISTINCT id) FROM trajectory_data WHERE frame > 280 AND pos_y < -0.5")" 30 80
[ -s "$work/g/paths.png" ] && [ -s "$work/g/density.png" ]; verdict "the report has pictures" $?

# The same hash for any number of threads that compute distance fields, and on one processor.
one=$(hash_of "$JOSTLE" $gates --for 32)
same_hash "gates: one hash for 1, 2 and 4 threads" "$one" "$(hash_of "$JOSTLE" $gates --for 32 --threads 2)" "$(hash_of "$JOSTLE" $gates --for 32 --threads 4)"
if command -v taskset >/dev/null; then
    same_hash "gates: the same hash on one processor" "$one" "$(taskset -c 0 "$JOSTLE" run $gates --for 32 --threads 3 --quiet --summary - 2>/dev/null | figure hash)"
fi
without=$(hash_of "$JOSTLE" $gates --for 32 --set events.2.at=16)
[ -n "$without" ] && [ "$without" != "$one" ]; verdict "a gate that opens a second later differs" $?

# A block lands in the near door while people walk there: they turn to the far one, and all leave.
cp behaviours/evacuee.lua "$work"
cat >"$work/block.yaml" <<'END'
jostle: 1
duration: 60
places:
  hall: {polygon: [[1, 1], [9, 1], [9, 19], [1, 19]]}
  out: {polygon: [[14, 4], [16, 4], [16, 16], [14, 16]]}
walls:
  - {line: [[10, 4], [10, 0], [0, 0], [0, 20], [10, 20], [10, 18]]}
  - {line: [[10, 6], [10, 16]]}
bodies: [{name: block, shape: {box: {size: [1, 1.9, 1.5]}}, mass: 4000, at: [30, 5, 0.75]}]
groups: {crowd: {behaviour: evacuee.lua, count: 30, in: hall, set: {exits: out, alarm: 0}}}
events: [{at: 8, throw: block, from: [10.3, 5, 0.8], velocity: [0, 0, 0]}]
END
"$JOSTLE" run "$work/block.yaml" --quiet --record "$work/b.sqlite" --summary "$work/b.json" 2>/dev/null
between "everybody gets round the block" "$(figure agents <"$work/b.json")" 0 0
between "the block stays in the door" "$(sqlite3 "$work/b.sqlite" "SELECT max(abs(x - 10.3) + abs(y - 5)) FROM jostle_body WHERE frame > 100" 2>/dev/null)" 0 0.3
between "people leave by the near door before the block lands" "$(sqlite3 "$work/b.sqlite" "SELECT count(DISTINCT id) FROM trajectory_data WHERE frame < 80 AND pos_x > 10 AND pos_y < 7")" 1 20
between "people leave by the far door after it" "$(sqlite3 "$work/b.sqlite" "SELECT count(DISTINCT id) FROM trajectory_data WHERE frame > 80 AND pos_x BETWEEN 9.9 AND 10.5 AND pos_y > 15")" 10 30

wrong() { # NAME TEXT ARGS...: checks that a run is refused as bad input with a text
    local name=$1 text=$2; shift 2
    "$JOSTLE" run $gates --quiet --steps 1 "$@" >"$work/out" 2>&1
    if [ $? = 3 ] && grep -qF -- "$text" "$work/out"; then echo "ok $name"; else
        echo "not ok $name"; head -5 "$work/out"; fi
}
wrong "an event on an unknown wall is refused" "there is no wall named 'est_gate'. Did you mean 'east_gate'?" --set events.2.open=est_gate
wrong "an event on an unknown body is refused" "Did you mean 'crate'?" --set events.1.throw=create
wrong "a throw of a static body is refused" "cannot be thrown" --set bodies.0.mass=0
printf 'jostle: 1\nbodies: [{name: crate, shape: {sphere: {radius: 1}}, mass: 3, at: [0, 0, 1]}, {name: lift, shape: {sphere: {radius: 1}}, kinematic: true, at: [9, 0, 1]}]\ngroups: {g: {behaviour: stander.lua, at: [[5, 5]]}}\nevents: [{at: 1, WHAT}]\n' >"$work/move.yaml"
moves() { # NAME TEXT EVENT
    sed "s/WHAT/$3/" "$work/move.yaml" >"$work/moved.yaml"
    "$JOSTLE" check "$work/moved.yaml" 2>&1 | grep -qF -- "$2"; verdict "$1" $?
}
moves "a move of a body that is not kinematic" "is not kinematic: it has no velocity of its own" "move: crate, velocity: [1, 0, 0]"
moves "a move without a velocity" "a move needs a velocity or a spin" "move: lift"
moves "a move from a point" "from belongs to a throw" "move: lift, from: [0, 0, 1], velocity: [1, 0, 0]"
moves "a throw of one that is kinematic" "Write move: NAME" "throw: lift, velocity: [1, 0, 0]"
moves "a move as it should be" "nothing wrong" "move: lift, velocity: [1, 0, 0]"
wrong "an event before time 0 is refused" "at must be from 0" --set events.0.at=-2
wrong "an open wall without a name is refused" "needs a name" --set walls.0.open=true
sed 's/signal: alarm}/signal: alarms}/' $gates >"$work/deaf.yaml"
"$JOSTLE" check "$work/deaf.yaml" 2>&1 | grep -qF "hears the signal 'alarms'. Did you mean 'alarm'?"
verdict "a signal that no agent hears gives a warning" $?

# Tallies of memory, states and groups: in the last lines and the summary; unknown names.
cat >"$work/tally.yaml" <<'END'
jostle: 1
duration: 4
places: {yard: {polygon: [[-4, -4], [4, -4], [4, 4], [-4, 4]]}}
groups:
  one: {behaviour: counter.lua, in: yard, count: 3}
  two: {behaviour: counter.lua, in: yard, count: 2}
tally:
  ones: {memory: steps, group: one, unit: points}
  twos: {memory: steps, group: two, unit: points}
END
cat >"$work/counter.lua" <<'END'
local mine = memory { steps = 0 }
return machine { name = "counter", version = 1, start = "A", states = {
  A = { steer = hold, lasts = 0.98, set = { steps = mine.steps + 1 }, { to = "B", when = lasted } },
  B = { steer = hold, { to = "A" } } } }
END
"$JOSTLE" run "$work/tally.yaml" --summary "$work/tally.json" >"$work/out" 2>&1
ones=$(count ones "$work/tally.json") twos=$(count twos "$work/tally.json")
between "a memory is summed over a group" "$ones" 9 15
[ $((2 * ones)) = $((3 * twos)) ] && tr '\n' ' ' <"$work/out" | grep -q "ones $ones points, twos $twos points: ones is ahead."; verdict "the last lines say which score is ahead" $?
sed -i '/ones:/,$d' "$work/tally.yaml"
cat >>"$work/tally.yaml" <<'END'
  there: {group: two}
  in B: {state: B}
  most: {memory: steps, take: greatest}
  gone: {memory: stepped}
END
"$JOSTLE" run "$work/tally.yaml" >"$work/out" 2>&1
tr '\n' ' ' <"$work/out" | grep -qE "there 2, in B [0-5], most [345], gone 0\."; verdict "scores count agents and take the greatest value" $?
grep -q "no behaviour of the scene has a memory 'stepped'. Did you mean 'steps'?" "$work/out"; verdict "an unknown memory is refused with the nearest name" $?

# States that run machines: how many people are in all states within.
"$JOSTLE" run tests/data/nested.yaml --for 3 --quiet --summary "$work/nested.json"
python3 - "$work/nested.json" <<'END'
import json, sys
summary = json.load(open(sys.argv[1]))
inner, outer = summary["states"], summary["outer_states"]
assert sorted(outer) == ["guard", "warden"] and sorted(outer["warden"]) == ["Day", "Day.4 run", "Night", "Night.Round"], outer
for machine, sums in outer.items():
    for name, people in sums.items():
        assert people == sum(n for state, n in inner[machine].items() if state.startswith(name + ".")), (machine, name)
assert outer["guard"]["Guard"] > 0
END
verdict "the summary sums the people within states that run machines" $?
"$JOSTLE" run tests/data/nested.yaml --for 1.5 2>&1 | tr '\n' ' ' | grep -qE "guard Greet [0-9]+, guard Guard [0-9]+ \(End [0-9]+, Look [0-9]+, Walk [0-9]+\), guard Rest [0-9]+, warden Night 20 \(Round 20 \(Look [0-9]+, Walk [0-9]+\)\), patrol End 10\."
verdict "  and so do the last lines" $?
exit 0
