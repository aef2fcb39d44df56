# `jostle report`, and probes of a run: the same figures, files where they are asked for, errors with a way out.
. tests/scenes/lib.sh
expect() { # NAME STATUS TEXT COMMAND...: the exit status, and a text in the output
    local name=$1 status=$2 text=$3; shift 3
    timeout 60 "$@" >"$work/out" 2>&1 </dev/null
    local got=$?
    if [ $got = "$status" ] && grep -qF -- "$text" "$work/out"; then echo "ok $name"; else
        echo "not ok $name: status $got, wanted $status and '$text'"; head -5 "$work/out"; fi
}
# of FILE PROBE FIGURE
of() { sed -n "s/^  \"$2\": {.*\"$3\": \([^,}]*\).*/\1/p" "$1"; }

cat >"$work/walk.yaml" <<'SCENE'
jostle: 1
step: 0.05
duration: 20
places:
  yard: {polygon: [[0, 0], [6, 0], [6, 4], [0, 4]]}
  east: {point: [25, 2], radius: 1}
groups:
  walkers: {behaviour: walker.lua, count: 30, fill: random, in: yard, set: {goal: east}}
  standers: {behaviour: stander.lua, at: [[30, 10], [31, 10]]}
probes:
  line:   {flow: [[10, 8], [10, -4]]}
  square: {measure: [[8, 0], [12, 0], [12, 4], [8, 4]]}
  way:    {transit: [[[8, -4], [8, 8]], [[14, -4], [14, 8]]], group: walkers}
  moved:  {displacement: true, group: standers}
  fields: {map: {}, every: 2}
  turned: {winding: [0, 20]}
  order:  {lanes: {area: [[0, 0], [20, 4]]}}
SCENE
# A world of no mods beside it: behaviours are the installed ones.
"$JOSTLE" run "$work/walk.yaml" --quiet --record "$work/walk.sqlite" --report "$work/run" --summary "$work/run.json" >/dev/null 2>&1
verdict "a run with probes" $?
"$JOSTLE" report "$work/walk.sqlite" --scene "$work/walk.yaml" --out "$work/again" --summary "$work/again.json" >"$work/out" 2>&1
verdict "a report on its recording" $?
same() { # PROBE FIGURE WITHIN: in the run and in its recording
    local a b; a=$(of "$work/run.json" "$1" "$2"); b=$(of "$work/again.json" "$1" "$2")
    awk -v a="$a" -v b="$b" -v d="$3" 'BEGIN {exit !(a != "" && a != "null" && a - b <= d && b - a <= d)}'
    if [ $? = 0 ]; then echo "ok $1: $2 of the recording is that of the run ($a, $b)"; else echo "not ok $1: $2 is $a in the run, $b in its recording"; fi
}
same line passages 0; same line flow 0.01; same line first 0.03
same square density 0.05; same square speed 0.05
same way passages 0; same way mean 0.03
same moved people 0; same fields density_max 0.1; same turned mean 0.01; same order order 0
[ "$(of "$work/again.json" line passages)" = 30 ]; verdict "everyone passes the line" $?
for name in line square way moved fields turned order; do
    for end in csv png svg; do
        [ -s "$work/run/$name.$end" ] && [ -s "$work/again/$name.$end" ] || { echo "not ok $name.$end is missing"; false; }
    done
    verdict "files of $name" $?
done
[ "$(head -1 "$work/run/line.csv")" = "time [s],person,direction,passages,lapse [s]" ]; verdict "a CSV file names its columns and units" $?

# Probes see, and change nothing.
sed '/^probes:/,$d' "$work/walk.yaml" >"$work/blind.yaml"
same_hash "probes change nothing" "$(hash_of "$JOSTLE" "$work/walk.yaml" --for 10)" "$(hash_of "$JOSTLE" "$work/blind.yaml" --for 10)"
for threads in 1 2 3; do "$JOSTLE" run "$work/walk.yaml" --for 15 --quiet --threads $threads --summary - 2>/dev/null | sed -n '/"probes"/,/^ }/p' >"$work/probes.$threads"; done
cmp -s "$work/probes.1" "$work/probes.2" && cmp -s "$work/probes.1" "$work/probes.3" && [ -s "$work/probes.1" ]; verdict "figures do not depend on threads" $?

expect "report without a scene" 0 '"all": {"intervals": ' "$JOSTLE" report "$work/walk.sqlite" --summary - --out "$work/plain"
[ -s "$work/plain/map.png" ] && [ -s "$work/plain/all.svg" ]; verdict "its pictures" $?
printf '1 0 0 0\n1 1 10 0\n1 2 20 0\n' >"$work/bare.txt"
expect "no frame rate" 3 "--fps 25" "$JOSTLE" report "$work/bare.txt" --summary -
expect "no unit" 3 "--unit m, or --unit cm" "$JOSTLE" report "$work/bare.txt" --fps 10 --summary -
expect "both given" 0 '"until_s": 0.2' "$JOSTLE" report "$work/bare.txt" --fps 10 --unit cm --summary -
expect "groups that a recording lacks" 3 "which this recording does not name" "$JOSTLE" report "$work/bare.txt" --fps 10 --unit cm --scene "$work/walk.yaml" --summary -
printf 'jostle: 1\nprobes: {a: {failures: 1}}\n' >"$work/fails.yaml"
expect "failures need a run" 3 "Measure it during a run" "$JOSTLE" report "$work/bare.txt" --fps 10 --unit cm --scene "$work/fails.yaml" --summary -
expect "a scene without probes" 3 "this scene has no probes" "$JOSTLE" report "$work/bare.txt" --fps 10 --unit cm --scene scenes/circle.yaml --summary -
printf '1 0 0 0\n1 1 zero 0\n' >"$work/bad.txt"
expect "an error in a recording" 3 "bad.txt:2:5" "$JOSTLE" report "$work/bad.txt" --fps 10 --unit m --summary -
expect "no such recording" 3 "cannot be read" "$JOSTLE" report "$work/none.txt" --summary -
expect "unwritable folder" 1 "cannot make" "$JOSTLE" report "$work/walk.sqlite" --out /proc/x/y
expect "nothing asked for" 2 "give --out DIR" "$JOSTLE" report "$work/walk.sqlite"
expect "a unit that is none" 2 "--unit is m or cm" "$JOSTLE" report "$work/bare.txt" --unit inch --summary -
expect "report --help" 0 "PeTrack" "$JOSTLE" report --help
