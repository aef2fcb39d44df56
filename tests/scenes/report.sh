# jostle report, and probes of a run: equal figures, files, errors and their remedies.
. tests/scenes/lib.sh
# of FILE PROBE FIGURE: prints a figure of a probe
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
# Behaviours are the installed ones.
"$JOSTLE" run "$work/walk.yaml" --quiet --record "$work/walk.sqlite" --report "$work/run" --summary "$work/run.json" >/dev/null 2>&1
verdict "a run with probes" $?
"$JOSTLE" report "$work/walk.sqlite" --scene "$work/walk.yaml" --out "$work/again" --summary "$work/again.json" >"$work/out" 2>&1
verdict "a report on its recording" $?
same() { # PROBE FIGURE WITHIN: compares a figure of the run with that of its recording
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

# Probes do not change a run.
sed '/^probes:/,$d' "$work/walk.yaml" >"$work/blind.yaml"
same_hash "probes change nothing" "$(hash_of "$JOSTLE" "$work/walk.yaml" --for 10)" "$(hash_of "$JOSTLE" "$work/blind.yaml" --for 10)"
for threads in 1 2 3; do "$JOSTLE" run "$work/walk.yaml" --for 15 --quiet --threads $threads --summary - 2>/dev/null | sed -n '/"probes"/,/^ }/p' >"$work/probes.$threads"; done
cmp -s "$work/probes.1" "$work/probes.2" && cmp -s "$work/probes.1" "$work/probes.3" && [ -s "$work/probes.1" ]; verdict "figures do not depend on threads" $?

expect "report without a scene" 0 '"all": {"intervals": ' "$JOSTLE" report "$work/walk.sqlite" --summary - --out "$work/plain"
[ -s "$work/plain/map.png" ] && [ -s "$work/plain/all.svg" ]; verdict "the report has pictures" $?
printf '1 0 0 0\n1 1 10 0\n1 2 20 0\n' >"$work/bare.txt"
expect "a recording without a frame rate is refused" 3 "--fps 25" "$JOSTLE" report "$work/bare.txt" --summary -
expect "a recording without a unit is refused" 3 "--unit m, or --unit cm" "$JOSTLE" report "$work/bare.txt" --fps 10 --summary -
expect "--fps and --unit give both" 0 '"until_s": 0.2' "$JOSTLE" report "$work/bare.txt" --fps 10 --unit cm --summary -
expect "groups that a recording lacks" 3 "which this recording does not name" "$JOSTLE" report "$work/bare.txt" --fps 10 --unit cm --scene "$work/walk.yaml" --summary -
printf 'jostle: 1\nprobes: {a: {failures: 1}}\n' >"$work/fails.yaml"
expect "a probe that needs a run is refused for a recording" 3 "Measure it during a run" "$JOSTLE" report "$work/bare.txt" --fps 10 --unit cm --scene "$work/fails.yaml" --summary -
expect "a scene without probes" 0 '"all": {"intervals": ' "$JOSTLE" report "$work/bare.txt" --fps 10 --unit cm --scene scenes/circle.yaml --summary -

# Danger in recordings: by Jostle as in the run, by others without forces; who left; the page.
"$JOSTLE" run scenes/evacuation.yaml --for 60 --quiet --no-half-step --record "$work/evac.sqlite" --record-every 0.05 --data "$work/evac" --report "$work/evac-run" --summary "$work/evac.json" 2>/dev/null
"$JOSTLE" report "$work/evac.sqlite" --scene scenes/evacuation.yaml --out "$work/evac-page" --summary "$work/evac-again.json" >/dev/null 2>&1
verdict "a report on an evacuation" $?
number() { sed -n "/\"danger\": /,\$s/.*\"$1\": \([-0-9.e]*\|null\)[,} ].*/\1/p" "$2" | head -1; } # KEY FILE
near() { # KEY WITHIN: compares a figure of danger of the run with that of its recording
    local a b; a=$(number "$1" "$work/evac.json"); b=$(number "$1" "$work/evac-again.json")
    awk -v a="$a" -v b="$b" -v d="$2" 'BEGIN {exit !(a != "" && a + 0 > 0 && a - b <= d && b - a <= d)}'
    verdict "danger: $1 is that of the run ($a, $b)" $?
}
# The time of the greatest density is not sharp, so it is not compared.
near left 0; near clearance_s 0.11; near density_max 0.15; near density_max_s 2; near compression_max 6; near compression_max_s 0.11
for key in load_max dose_max; do # from means between frames, held for a second, as from every step
    a=$(number $key "$work/evac.json") b=$(number $key "$work/evac-again.json")
    awk -v a="$a" -v b="$b" 'BEGIN {exit !(a != "" && b != "" && a - b <= 0.04 * a && b - a <= 0.04 * a)}'
    verdict "danger: $key is that of the run ($a, $b)" $?
done
# Its last row is that of the run to the step, though the recording goes on without people.
[ "$(sed -n 2p "$work/evac-page/table-leaving.csv")" = "$(awk -F, '$1 == "all"' "$work/evac-run/table-leaving.csv")" ]; verdict "the recording has the run's times of leaving" $?
for file in index.html danger.csv danger.png levels.png plan.svg snapshot-2.png; do [ -s "$work/evac-page/$file" ]; verdict "the report has $file" $?; done
tail -1 "$work/evac-page/danger.csv" | awk -F, '{exit !($2 == 0 && $NF == 140)}'; verdict "danger.csv ends with nobody there and 140 who left" $?
missing=0
for link in $(grep -o '\(src\|href\)="[^"#]*"' "$work/evac-page/index.html" | cut -d'"' -f2); do [ -s "$work/evac-page/$link" ] || missing=1; done
verdict "pictures of the page lie beside it" $missing
grep -qF "$(sha256sum "$work/evac.sqlite" | cut -c1-64)" "$work/evac-page/index.html"; verdict "the page names the recording by its hash" $?
"$JOSTLE" report "$work/walk.sqlite" --scene "$work/walk.yaml" --title "Yard, as it was" --author "A. Engineer" --organisation "Crowd Ltd" --project "P 7" --reference "R 1" \
    --checked-by "B. Second" --approved-by "C. Third" --date 2026-05-04 --out "$work/signed" >/dev/null 2>&1
head -60 "$work/signed/index.html" | tr '\n' ' ' >"$work/head"
for text in "<h1>Yard, as it was</h1>" "<th>Author<td>A. Engineer" "<th>Organisation<td>Crowd Ltd" "<th>Project<td>P 7" "<th>Reference<td>R 1" "<th>Date of this report<td>2026-05-04" "<td>Checked by<td>B. Second" "<td>Approved by<td>C. Third"; do
    grep -qF "$text" "$work/head"; verdict "options of report state: $text" $?
done
awk 'BEGIN {print "# framerate: 10 fps"; for (f = 0; f < 300; f++) for (i = 0; i < 169; i++) if (i || f < 200) print i, f, (i % 13) * 0.37 + 0.05 * sin(f / 3 + i), int(i / 13) * 0.37, 0}' >"$work/dense.txt"
"$JOSTLE" report "$work/dense.txt" --unit m --out "$work/dense" --summary "$work/dense.json" >/dev/null 2>&1
verdict "a report on positions alone" $?
between "danger: the density of a grid 0.37 m wide" "$(number density_max "$work/dense.json")" 7.0 7.7
between "danger: somebody is over 5 per m2 from the start" "$(grep -o '"density_5": {[^}]*}' "$work/dense.json" | sed 's/.*"first_s": \([^,]*\),.*/\1/')" 0 0
grep -q '"load_623": {"people": null' "$work/dense.json" && grep -q '"pressure_002": {"people": [0-9]' "$work/dense.json"; verdict "compression is not known, crowd pressure is" $?
[ "$(number left "$work/dense.json")" = 1 ]; verdict "one person has left" $?
between "time at which it left, s" "$(number last_left_s "$work/dense.json")" 20 20
grep -q '"inside": 168,$' "$work/dense.json" && grep -q '"clearance_s": null,$' "$work/dense.json" && grep -q "<td class=n>not cleared" "$work/dense/index.html"; verdict "168 are still inside: not cleared" $?
grep -q "Compression was not measured" "$work/dense/index.html" && ! grep -q "Compression was not measured" "$work/evac-page/index.html"; verdict "the page says that compression was not measured" $?
printf '1 0 0 0\n1 1 zero 0\n' >"$work/bad.txt"
expect "an error in a recording" 3 "bad.txt:2:5" "$JOSTLE" report "$work/bad.txt" --fps 10 --unit m --summary -
expect "no such recording" 3 "cannot be read" "$JOSTLE" report "$work/none.txt" --summary -
expect "unwritable folder" 1 "cannot make" "$JOSTLE" report "$work/walk.sqlite" --out /proc/x/y
expect "a call without --out and --summary is refused" 2 "give --out DIR" "$JOSTLE" report "$work/walk.sqlite"
expect "an unknown unit is refused" 2 "--unit is m or cm" "$JOSTLE" report "$work/bare.txt" --unit inch --summary -
expect "report --help" 0 "PeTrack" "$JOSTLE" report --help
# Names have letters and digits, titles any text. Neither is carried out as a command.
sed 's/^  walkers: {/  "`id > x`": {/' "$work/walk.yaml" >"$work/named.yaml"
expect "a group that is named like a command" 3 "named.yaml:8:3: '\`id > x\`' is no name for a group" "$JOSTLE" run "$work/named.yaml" --quiet --report "$work/named"
expect "check refuses it too" 3 "Letters, digits, spaces, _ - and . are allowed" "$JOSTLE" check "$work/named.yaml"
sed "s/^step:/title: '\`touch pwned\` \$(touch pwned) \"; system(\"touch pwned\") <\/script><script>'\nstep:/; s/^duration: 20/duration: 1/" "$work/walk.yaml" >"$work/titled.yaml"
expect "a title that looks like a command is text" 0 "report:" "$JOSTLE" run "$work/titled.yaml" --report "$work/titled"
[ -z "$(find "$work" . -maxdepth 2 \( -name pwned -o -name x \) -newer "$work/named.yaml" 2>/dev/null)" ] && [ ! -e "$work/titled/pwned" ]; verdict "neither is carried out" $?
[ -s "$work/titled/paths.png" ] && ! grep -q "<script" "$work/titled/index.html"; verdict "the pictures are drawn" $?
# A recording made here, so that its page always has the same ranges: a queue of 40 passes a door, one a second.
cat >"$work/made.yaml" <<'SCENE'
jostle: 1
title: A queue at a door
places:
  hall: {polygon: [[0, 0], [8, 0], [8, 4], [0, 4]]}
  street: {polygon: [[9, 1], [11, 1], [11, 3], [9, 3]]}
walls: [{line: [[8, 1.5], [8, 0], [0, 0], [0, 4], [8, 4], [8, 2.5]]}]
probes:
  door: {flow: [[8, 2.5], [8, 1.5]]}
  before: {measure: [[6, 1], [8, 1], [8, 3], [6, 3]], every: 0.5}
SCENE
awk 'BEGIN {print "# framerate: 5 fps"; for (f = 0; f < 250; f++) for (i = 0; i < 40; i++) {x = 7.8 - 0.4 * int(i / 2) + (f / 5 - i) * (f / 5 > i) * 1.2; if (x < 10) print i, f, x, 1.8 + 0.4 * (i % 2), 0}}' >"$work/made.txt"
"$JOSTLE" report "$work/made.txt" --unit m --scene "$work/made.yaml" --out "$work/made" >/dev/null 2>&1
verdict "a report on a made-up recording" $?
outlined "its page, its plots and their ranges are as they were looked at" "$work/made" recording
grep -q "39 of 40 people left: the first at [0-9.]* s, half of them by 2[0-9.]* s" "$work/made/index.html" && grep -q "Not cleared\|No. 1 person was still inside" "$work/made/index.html" && grep -q "at 0.0 s at (0.2, 2.0) m, in hall" "$work/made/index.html"; verdict "its summary says who left, and where it was dense" $?

# Criteria: figure, limit and verdict in the summary, the page, the last lines and the exit status; the share of seeds.
cat >"$work/held.yaml" <<'SCENE'
include: made-run.yaml
jostle: 1
report: {author: A. Engineer, notes: Counted on 12 May.}
criteria:
  out in time: {cleared: 30, margin: 1.5}
  out at once: {cleared: 5}
  room: {density: 1, at: hall, lasting: 60}
  packed: {density: 0.01}
  door: {flow: 10, of: door}
  through: {waiting: 30, of: passage}
  hurt: {load: 6000}
  spot: {density: 0.01, at: spot}
  post: {density: 0.01, at: post}
  field: {density: 9, at: field}
SCENE
cat >"$work/made-run.yaml" <<'SCENE'
jostle: 1
title: A hall with a door
duration: 30
bounds: [[-1, -1], [16, 7]]
places:
  hall: {polygon: [[0, 0], [8, 0], [8, 6], [0, 6]]}
  exit: {point: [14, 3], radius: 1}
  spot: {polygon: [[4.02, 3.02], [4.05, 3.02], [4.05, 3.05], [4.02, 3.05]]} # smaller than a cell
  post: {point: [4.02, 3.02], radius: 0.02}
  field: {polygon: [[30, 0], [34, 0], [34, 4], [30, 4]]} # not measured
walls: [{line: [[8, 2.4], [8, 0], [0, 0], [0, 6], [8, 6], [8, 3.6]]}]
groups:
  people: {behaviour: walker.lua, count: 12, in: hall, set: {goal: exit, speed: 'normal(1.3, 0.2, 0.8, 1.8)'}, basis: a count}
sinks: [{at: exit}]
probes: {door: {flow: [[8, 3.6], [8, 2.4]]}, passage: {transit: [[[6, 6], [6, 0]], [[8, 3.6], [8, 2.4]]]}}
SCENE
"$JOSTLE" run "$work/held.yaml" --no-half-step --record "$work/held.sqlite" --report "$work/held" --summary "$work/held.json" >"$work/out" 2>&1
[ $? = 1 ]; verdict "a run that fails a criterion ends with status 1" $?
tr -s ' \n' ' ' <"$work/out" | grep -q 'Criterion out in time: met .* Criterion out at once: not met'; verdict "the last lines say which criteria are met" $?
verdicts() { sed -n 's/^  "\(.*\)": {"figure": \([^,]*\), "limit": .*"met": \([^}]*\)}.*/\1 \3/p' "$1"; }
wanted='out in time 1
out at once 0
room 1
packed 0
door 1
through 1
hurt 1
spot 0
post 0
field null'
[ "$(verdicts "$work/held.json")" = "$wanted" ]; verdict "the summary has a verdict on each" $?
last=$(number clearance_s "$work/held.json")
between "the time required is the clearance time, times the margin" "$(sed -n 's/.*"out in time": {"figure": \([^,]*\).*/\1/p' "$work/held.json")" "$(awk -v t="$last" 'BEGIN {print 1.5 * t - 0.001}')" "$(awk -v t="$last" 'BEGIN {print 1.5 * t + 0.001}')"
grep -q '^out at once,not met,.*,5,s,"time required: ' "$work/held/table-criteria.csv" && grep -q "5 of 10 met in this run; out at once: not met, packed: not met, spot: not met, post: not met, field: not decided" "$work/held/index.html"; verdict "the page has the same verdicts" $?
grep -q '^speed,people,"normal(1.3, 0.2, 0.8, 1.8) (scene)",12,1.[0-9]*,0.[0-9]*,' "$work/held/table-values.csv" && grep -q '^people,12,12,in hall,"\{0,1\}walker.lua; goal: exit"\{0,1\},,a count$' "$work/held/table-groups.csv"; verdict "inputs: values as given and as drawn, with their basis" $?
"$JOSTLE" report "$work/held.sqlite" --scene "$work/held.yaml" --out "$work/held-again" --summary "$work/held-again.json" >/dev/null 2>&1
[ "$(verdicts "$work/held-again.json")" = "$wanted" ]; verdict "its recording has the same verdicts" $?
"$JOSTLE" run "$work/held.yaml" --seeds 3 --quiet --report "$work/held-seeds" --summary "$work/held-seeds.json" >/dev/null 2>&1
grep -q '"criteria.out at once.met": {"mean": 0,' "$work/held-seeds.json" && grep -q '<td>out in time<td class=n>3<td class=n>0' "$work/held-seeds/index.html" && grep -q '^out at once,0,3,0,0,' "$work/held-seeds/table-criteria.csv"; verdict "with seeds, the share that meets each" $?
grep -q '^field,not decided,,9,1/m2,not measured: no part of field lies in the measured area$' "$work/held/table-criteria.csv"; verdict "a place that is not measured decides nothing" $?
cat >"$work/later.yaml" <<'SCENE'
include: made-run.yaml
jostle: 1
groups: {later: {behaviour: walker.lua, starts: [[100, 2, 3]], set: {goal: exit}}}
criteria: {in time: {cleared: 30}}
SCENE
"$JOSTLE" run "$work/later.yaml" --quiet --for 30 --summary "$work/later.json" >/dev/null 2>&1
[ "$(verdicts "$work/later.json")" = 'in time null' ]; verdict "somebody who starts after the end leaves the time to clear undecided" $?
# People may come after the end, so nobody knows how long the room takes to clear; half of a place is outside the measured area.
cat >"$work/late.yaml" <<'SCENE'
include: made-run.yaml
jostle: 1
places: {half: {polygon: [[14, 0], [18, 0], [18, 4], [14, 4]]}}
sources: [{at: hall, like: people, from: 100, every: 5, people: 1}]
criteria: {in time: {cleared: 30}, half: {density: 9, at: half}}
SCENE
"$JOSTLE" run "$work/late.yaml" --quiet --for 30 --summary "$work/late.json" >/dev/null 2>&1
[ "$(verdicts "$work/late.json" | tr '\n' ' ')" = 'in time null half null ' ]; verdict "people to come, and a place that is measured in part, decide nothing" $?
wrong() { # TEXT CRITERION: check must refuse the criterion
    printf 'include: made-run.yaml\njostle: 1\ncriteria:\n  it: {%s}\n' "$2" >"$work/wrong.yaml"
    expect "a criterion {$2}" 3 "$1" "$JOSTLE" check "$work/wrong.yaml"
}
wrong "wrong.yaml:4:7: the criterion 'it' needs a probe" "flow: 1"
wrong "wrong.yaml:4:21: there is no probe 'dor'. Did you mean 'door'?" "flow: 1, of: dor"
wrong "wrong.yaml:4:24: waiting takes its figure from a probe of transit or visit" "waiting: 1, of: door"
wrong "'at' goes with density" "cleared: 1, at: hall"
printf 'include: made-run.yaml\njostle: 1\nprobes: {late: {flow: [[8, 3.6], [8, 2.4]], from: 100}}\ncriteria: {it: {flow: 1, of: late}}\n' >"$work/late-flow.yaml"
expect "a flow is not judged by a probe of a part of the run" 3 "late-flow.yaml:4:30: a flow is held against its limit over the whole run and of everybody" "$JOSTLE" check "$work/late-flow.yaml"
