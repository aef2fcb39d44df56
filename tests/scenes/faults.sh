# Faults of scenes and runs: messages and exit statuses.
. tests/scenes/lib.sh
program=$(case $JOSTLE in /*) echo "$JOSTLE" ;; *) echo "$PWD/$JOSTLE" ;; esac)
yard=$work/yard
mkdir -p "$yard"
cp behaviours/stander.lua "$yard/"
says() { # NAME STATUS TEXT COMMAND...
    local name=$1 status=$2 text=$3; shift 3
    (cd "$yard" && timeout 60 "$@") >"$work/out" 2>&1 </dev/null
    local got=$?
    if [ $got = "$status" ] && grep -qF -- "$text" "$work/out"; then echo "ok $name"; else
        echo "not ok $name: status $got, wanted $status and '$text'"; head -8 "$work/out"; fi
}
behaviour() { # STEER: odd.lua
    printf 'return machine { name = "odd", start = "A", states = { A = { steer = %s } } }\n' "$1" >"$yard/odd.lua"
}
# scene GROUPS-AND-MORE: scene.yaml, with a yard, a corridor and a circle
scene() {
    printf 'jostle: 1\nplaces:\n  yard: {polygon: [[0, 0], [20, 0], [20, 20], [0, 20]]}\n' >"$yard/scene.yaml"
    printf '  corridor: {polygon: [[30, 0], [70, 0], [70, 1], [30, 1]]}\n  ring: {point: [50, 50], radius: 5}\n%s\n' "$1" >>"$yard/scene.yaml"
}

# ---- numbers that are not finite ----
scene 'groups:
  people: {behaviour: stander.lua, count: 100, fill: grid, in: yard}
  odd: {behaviour: odd.lua, at: [[10, 10], [10.4, 10]], team: a}'
for steer in 'together(-5)' 'drift(1e39, 0)' 'follow(nearest "anyone", 1e39)'; do
    behaviour "$steer"
    says "a run refuses $steer" 3 " must be from " "$program" run scene.yaml --for 1 --quiet
    says "  check refuses it too" 3 "odd.lua:1:70: " "$program" check scene.yaml
done
behaviour 'drift(100, 0)'
says "values within the ranges run" 0 '"agents": 102' "$program" run scene.yaml --for 1 --quiet --summary -

# ---- behaviours that were suspended ----
behaviour 'function(me) return me.x + nil, 0 end'
sed -i 's/count: 100/count: 10/; s/at: \[\[10, 10\], \[10.4, 10\]\]/count: 30, in: yard/' "$yard/scene.yaml"
says "a suspended function ends the run with status 1" 1 "jostle run: behaviour odd.lua was suspended: " \
    "$program" run scene.yaml --for 2 --quiet --summary summary.json
[ "$(figure steps <"$yard/summary.json")" = 40 ]
verdict "  after its last step, with a summary" $?
says "  also with several seeds" 1 "was suspended" "$program" run scene.yaml --for 2 --quiet --seeds 2
behaviour 'function(me) if me.time < 0.1 then return nil, 0 end return 0, 0 end'
says "a function that failed a few times is not suspended" 0 "must return two numbers" "$program" run scene.yaml --for 2 --quiet

cp "$yard/scene.yaml" "$yard/many.yaml"
for agents in 1 2 4; do
    behaviour 'function(me) return me.x + nil, 0 end'
    sed "s/count: 30, in: yard/count: $agents, in: yard/" "$yard/many.yaml" >"$yard/scene.yaml"
    says "a function that fails in each call of $agents agents gives status 1" 1 \
        "jostle run: behaviour odd.lua failed: state A > steer, in $((40 * agents)) of $((40 * agents)) calls" \
        "$program" run scene.yaml --for 2 --quiet
    behaviour 'function(me) if me.time > 1.799 then return nil, 0 end return 0, 0 end'
    says "  also if it fails in a tenth of its calls" 1 "in $((4 * agents)) of $((40 * agents)) calls" "$program" run scene.yaml --for 2 --quiet
done
behaviour 'function(me) if me.time < 0.1 then return nil, 0 end return 0, 0 end'
says "in fewer, the last lines count them" 0 "8 failed calls of functions of" "$program" run scene.yaml --for 2
behaviour 'function(me) return me.x + nil, 0 end'
"$program" run "$yard/scene.yaml" --for 2 --quiet --checkpoint 1 --checkpoint-dir "$yard/points" >/dev/null 2>&1
says "failures are counted over a checkpoint" 1 "in 320 of 320 calls" "$program" resume points --for 4 --quiet

# ---- people who are lost ----
behaviour 'drift(1, 0)'
scene 'groups: {walkers: {behaviour: odd.lua, at: [[9999.5, 0], [9990, 3], [9990, 6]]}}'
says "an agent that leaves the world ends the run" 1 "the position of agent 0 is more than 10 km from the origin (machine" \
    "$program" run scene.yaml --for 4 --quiet --summary -
says "  or is removed, with status 1" 1 "; removed" "$program" run scene.yaml --for 4 --quiet --set guard.people=remove --summary summary.json
[ "$(figure agents <"$yard/summary.json") $(figure steps <"$yard/summary.json")" = "2 80" ]
verdict "  and the others go on to the last step" $?
says "  or is put back, and counted" 1 " times the numbers of somebody went wrong, who was put back" \
    "$program" run scene.yaml --for 4 --quiet --set guard.people=stop

# ---- driven bodies that press too hard ----
for at_limit in yield end; do
    behaviour hold
    scene "walls: [{line: [[-3, 0.3], [3, 0.3], [3, -0.3], [-3, -0.3]]}]
bodies: [{name: piston, shape: {box: {size: [0.5, 0.5, 2]}}, kinematic: true, at: [0, 0, 1], velocity: [0.5, 0, 0], force_limit: 900 N, at_limit: $at_limit}]
groups: {g: {behaviour: odd.lua, at: [[2, 0], [2.5, 0]]}}"
    if [ $at_limit = yield ]; then
        says "a piston stops at its force limit" 0 "" "$program" run scene.yaml --for 8 --summary summary.json
        tr '\n' ' ' <"$work/out" | grep -q 'Driven bodies met their force limits 1 time; body 0, piston pressed hardest, 1 person with 900 N'
        verdict "  with the load in the last lines" $?
        [ "$(python3 -c 'import json, sys; d = json.load(sys.stdin)["driven"]; print(round(d["greatest_N"]), d["inside"])' <"$yard/summary.json")" = "900 0" ]
        verdict "  and in the summary" $?
    else
        says "  or it ends the run, and names the person who is pressed" 1 "body 0, piston presses 1 person with 900 N, its limit" "$program" run scene.yaml --for 8 --quiet
    fi
done

# ---- starts and steps that are unsound ----
for setting in 'max_speed = 12' 'push = 5000, mass = 5'; do
    printf 'return machine { name = "odd", start = "A", states = {\n  A = { steer = hold,\n    %s } } }\n' "$setting" >"$yard/odd.lua"
    scene 'groups: {g: {behaviour: odd.lua, at: [[0, 0]]}}'
    for command in check "run --for 1 --quiet"; do
        says "$setting is too great for the step: warning by ${command%% *}" 0 "odd.lua:3: warning: in state A of odd people may " "$program" $command scene.yaml
        grep -qE '(0.6|2.5) m in a step of 0.05 s.*step: 0.0[0-9]+$' "$work/out"
        verdict "  with the figure" $?
    done
    says "  no warning at half the step" 0 '"steps": 100' "$program" run scene.yaml --for 1 --quiet --dt 0.01 --summary -
    ! grep -q "in a step of" "$work/out"
    verdict "  without a message" $?
done
behaviour hold
scene 'walls: [{solid: [[0, 0], [20, 0], [20, 20], [0, 20]]}]
groups:
  fit: {behaviour: odd.lua, at: [[-3, 0]]}
  walled: {behaviour: odd.lua, at: [[19, 10], [-5, 5], [18.5, 10]]}'
for command in check "run --for 1 --quiet"; do
    says "people inside a wall: warning by ${command%% *}" 0 "scene.yaml:9:3: warning: 2 of the 3 people of group 'walled' are not placed: (19, 10) lies in a wall" \
        "$program" $command scene.yaml
done
scene 'walls: [{solid: [[-30, -30], [60, -30], [60, 60], [-30, 60]]}]
groups: {g: {behaviour: odd.lua, at: [[10, 10]]}}'
says "  and a group of which nobody fits is refused" 3 "1 of the 1 person of group 'g' is not placed: (10, 10) lies in a wall" "$program" check scene.yaml
scene 'groups: {g: {behaviour: odd.lua, count: 30000, in: square}}'
sed -i 's/^places:/places:\n  square: {polygon: [[0, 0], [3, 0], [3, 3], [0, 3]]}/' "$yard/scene.yaml"
(ulimit -t 10 -v 2000000
for command in check "run --quiet"; do
    says "30,000 people on 9 m2 are refused within seconds by ${command%% *}" 3 "of the 30,000 people of group 'g' are not placed: no spot of its place is free" \
        "$program" $command scene.yaml
done
scene 'groups: {g: {behaviour: odd.lua, count: 100000, fill: circle, in: ring}}'
says "100,000 people on a circle are refused within seconds" 3 "100,000 agents on 31.4 m would stand less than 0.005 m apart" "$program" run scene.yaml --quiet
# A closed room: people who do not fit in it do not begin outside.
room() { # COUNT
    scene "walls: [{line: [[0, 0], [4, 0], [4, 4], [0, 4]], closed: true}]
groups: {g: {behaviour: odd.lua, count: $1, in: room, fill: random}}"
    sed -i 's/^places:/places:\n  room: {polygon: [[0.2, 0.2], [3.8, 0.2], [3.8, 3.8], [0.2, 3.8]]}/' "$yard/scene.yaml"
}
room 150
for command in check "run --for 1 --quiet --summary room.json --record room.sqlite"; do
    says "people who do not fit: warning by ${command%% *}" 0 "of the 150 people of group 'g' are not placed: no spot of its place is free" "$program" $command scene.yaml
done
grep -qF "Lower the count to 1" "$work/out"; verdict "  with the count that fits" $?
grep -q '"not_placed": 3.,' "$yard/room.json"; verdict "  and counted" $?
between "  and all others begin within the room" "$(sqlite3 "$yard/room.sqlite" "SELECT count(DISTINCT id) FROM trajectory_data WHERE pos_x BETWEEN 0 AND 4 AND pos_y BETWEEN 0 AND 4")" 110 120
rm "$yard/room.sqlite"
room 400
says "a count of which fewer than half fit is refused" 3 "people of group 'g' are not placed: no spot of its place is free" "$program" run scene.yaml --quiet
room 90
says "a count that fits is placed" 0 '"not_placed": 0' "$program" run scene.yaml --for 1 --quiet --summary - --record "$work/room.sqlite"
between "  within the room" "$(sqlite3 "$work/room.sqlite" "SELECT count(DISTINCT id) FROM trajectory_data WHERE pos_x BETWEEN 0 AND 4 AND pos_y BETWEEN 0 AND 4")" 90 90
# Overlapping bodies: two at one position, and copies that are larger than their distance.
{ printf 'jostle: 1\nbodies:\n'; for n in $(seq 1000); do echo '  - {shape: {sphere: {radius: 0.2}}, at: [0, 0, 1]}'; done; } >"$yard/scene.yaml"
says "bodies that begin inside each other are refused" 3 "pairs of bodies lie in each other" "$program" run scene.yaml --quiet
scene 'bodies: [{shape: {sphere: {radius: 90}}, at: [0, 0, 91], repeat: {count: [4096, 1, 1], step: [0.01, 0, 0]}}]'
says "copies that overlap are refused" 3 "pairs of bodies lie in each other" "$program" run scene.yaml --quiet)

# ---- sources and counts ----
behaviour 'seek(own.goal)'
scene 'groups: {g: {behaviour: odd.lua, count: 3, fill: circle, in: ring, set: {goal: antipode}}}
sources: [{at: yard, like: g, rate: 5}]'
says "a source of a group with goals opposite to their starts is refused" 3 "scene.yaml:7:28: group 'g' sets goal: antipode" "$program" run scene.yaml --for 2 --quiet
says "  check refuses it too" 3 "scene.yaml:7:28: group 'g' sets goal: antipode" "$program" check scene.yaml
scene 'groups: {g: {behaviour: stander.lua, count: 0}}
sources: [{at: yard, like: g, rate: 5, even: true}]'
says "a group may begin empty if a source fills it" 0 '"agents": 5' "$program" run scene.yaml --steps 21 --quiet --summary -
scene 'groups: {g: {behaviour: stander.lua, count: 0, in: yard}}'
says "  but not otherwise" 3 "where a source is like it" "$program" run scene.yaml --steps 1 --quiet
for fill in random hex grid; do
    scene "groups: {g: {behaviour: stander.lua, count: 1, fill: $fill, in: corridor}}"
    says "one agent fits into a corridor, fill: $fill" 0 '"agents": 1' "$program" run scene.yaml --steps 1 --quiet --summary -
done
# Sources inside walls are reported, and people who were due and did not come are counted.
sourced() { # WALL MORE
    scene "groups: {g: {behaviour: stander.lua, count: 0}}
walls: [$1]
sources:
  - {at: yard, like: g, $2}"
}
sourced '{solid: [[-1, -1], [21, -1], [21, 21], [-1, 21]]}' 'rate: 1'
for command in check "run --quiet"; do
    says "a source inside a solid is an error by ${command%% *}" 3 "scene.yaml:9:5: nobody of 'g' can come in at 'yard'" "$program" $command scene.yaml
done
sourced '{solid: [[-1, -1], [21, -1], [21, 21], [-1, 21]], name: cover}' 'rate: 1, even: true, until: 3'
says "  not if the solid can be opened" 0 "nothing wrong" "$program" check scene.yaml
told() { # NAME TEXT: checks that the output, without its line breaks, has a text
    tr -s '\n ' '  ' <"$work/out" | grep -qF -- "$2"; verdict "$1" $?
}
says "  and the scene runs" 0 "nobody left" "$program" run scene.yaml --for 4
told "  and the last lines say that nobody came" "0 of 3 people due came: source 'yard' (scene.yaml:9) lies in walls."
sourced '{line: [[5, -9], [5, 29]]}' 'rate: 1'
says "a source across a wall is a warning" 0 "scene.yaml:9:5: warning: 24 % of 'yard' lies in a wall or beyond one" "$program" check scene.yaml
sourced '{line: [[0, -9], [0, 29]]}' 'rate: 1'
says "  not a source beside the wall" 0 "nothing wrong" "$program" check scene.yaml
printf 'POLYGON ((-9 -9, 19 -9, 19 29, -9 29, -9 -9))\n' >"$yard/hall.wkt"
sourced '{file: hall.wkt}' 'rate: 1'
says "a source that extends beyond the walkable area is a warning" 0 "5 % of 'yard' lies outside the walkable area" "$program" check scene.yaml
printf 'POLYGON ((-9 -9, -2 -9, -2 29, -9 29, -9 -9))\n' >"$yard/hall.wkt"
says "  and an error if nobody can come in" 3 "nobody of 'g' can come in at 'yard': it lies outside the walkable area" "$program" check scene.yaml
sourced '' 'rate: 900, even: true, until: 5'
says "a run goes on if not all people who are due come in" 0 "nobody left" "$program" run scene.yaml --for 6 --no-half-step --report "$work/demand" --summary "$work/demand.json"
told "  and says so" " of 4,500 people due came: source 'yard' (scene.yaml:9) was full."
came=$(sed -n 's/.*"yard": {"due": 4500, "came": \([0-9]*\), "waiting": 0, "did_not_come": \([0-9]*\)}.*/\1 \2/p' "$work/demand.json")
[ "${came% *}" -gt 1000 ] && [ $((${came% *} + ${came#* })) = 4500 ]; verdict "  and counted: $came" $?
told "  as people who did not come before it ended" "It has ended:"
[ "$(tail -1 "$work/demand/danger-sources.csv")" = "yard,4500,${came% *},0,${came#* }" ] && grep -q "people due at yard" "$work/demand/index.html"; verdict "  also in the report" $?

# ---- memory that runs out ----
# limited LIMIT COMMAND...: runs with LIMIT KiB of address space; status 127 is that of the loader if libraries do not fit
limited() { local limit=$1; shift; (ulimit -v "$limit"; "$program" "$@") >"$work/out" 2>&1 </dev/null; }
failures=0 wrong=
for limit in 40000 50000 60000 70000 80000 90000 100000 110000 130000; do
    for command in "run scenes/tawaf.yaml --steps 3 --quiet --no-mods --set groups.pilgrims.count=20000" \
        "check scenes/tawaf.yaml behaviours/pedestrian.lua" "test tests/lua/customer_test.lua"; do
        limited $limit $command
        status=$?
        grep -q 'out of memory' "$work/out" && [ $status = 1 ] && failures=$((failures + 1)) && continue
        [ $status = 0 ] || [ $status = 127 ] || wrong="$wrong $limit:$status"
    done
done
[ $failures -ge 2 ] && [ -z "$wrong" ]
verdict "little memory: 'out of memory' and status 1 ($failures times${wrong:+, but$wrong})" $?

# ---- clocks that cannot be read ----
case $B in *san*) ;; *)
    ${CC:-gcc} -shared -fPIC -O1 -o "$work/clock.so" tests/faults/clock.c
    same_hash "a run without a clock has the same hash" "$(hash_of "$program" scenes/catch.yaml --for 2)" \
        "$(LD_PRELOAD=$work/clock.so hash_of "$program" scenes/catch.yaml --for 2 --record "$work/clock.sqlite")"
    [ "$(sqlite3 "$work/clock.sqlite" 'SELECT max(frame) FROM trajectory_data')" = 20 ]; verdict "  and a whole recording" $? ;;
esac
