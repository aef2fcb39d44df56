# Reports of runs: figures of danger, exits, the same run at half the step; and walls from files.
. tests/scenes/lib.sh
out=$work/report
# in_json KEY FILE: prints the first number after a key
in_json() { sed -n "s/.*\"$1\": \([-0-9.e]*\).*/\1/p" "$2" | head -1; }

"$JOSTLE" run scenes/evacuation.yaml --for 60 --report "$out" --summary "$work/run.json" >/dev/null 2>"$work/err"
verdict "a run with a report" $?
grep -q "once more at half the step, 0.025 s" "$work/err"; verdict "a run with a report is repeated at half the step, and says so" $?
[ "$(grep -c '60.0 of 60.0 s simulated' "$work/err")" = 2 ]; verdict "both runs show their progress" $?
for file in danger.csv danger.png danger.svg danger-map.csv danger-areas.csv danger-leaving.csv leaving.png levels.svg plan.svg density.png density-greatest.png load-greatest.svg snapshot-1.png snapshot-4.png index.html; do
    [ -s "$out/$file" ]; verdict "the report has $file" $?
done
head -1 "$out/danger.csv" | grep -q '^time \[s\],people,density_max \[1/m2\],.*,left,left_south_exit,left_east_exit$\|left_east_exit,left_south_exit$'; verdict "danger.csv names its columns, with the exits" $?
missing=0
for link in $(grep -o '\(src\|href\)="[^"]*"' "$out/index.html" | cut -d'"' -f2); do
    case $link in *:*) missing=1 ;; '#'*) continue ;; esac
    [ -s "$out/$link" ] || { echo "missing: $link"; missing=1; }
done
verdict "pictures of the page lie beside it" $missing
for text in "<h2 id=section-1>1&ensp;Summary</h2>" "<b>Cleared?</b> Yes, at " "All 140 people left: the first at " "step 0.05 s<th class=n>step 0.025 s<th class=n>difference" "person-seconds over a density of 5 per m²" "jostle reproduce" "None of that validates this scenario" "SHA-256"; do
    grep -qF "$text" "$out/index.html"; verdict "the page has: $text" $?
done
grep -qF "$(sha256sum scenes/evacuation.yaml | cut -c1-64)" "$out/index.html"; verdict "the page names its inputs by their hashes" $?

outlined "the page and its plots have their sections, titles and axes" "$out" run --no-ranges

# Everybody who left did so by an exit; danger.csv ends with the summary's count.
left=$(in_json left "$work/run.json")
south=$(in_json people <(grep -o '"south_exit": {[^}]*}' "$work/run.json")) east=$(in_json people <(grep -o '"east_exit": {[^}]*}' "$work/run.json"))
[ "$left" = 140 ] && [ $((south + east)) = 140 ]; verdict "everybody leaves, by one of two exits ($south and $east)" $?
between "the clearance time is that of the last person who left" "$(in_json clearance_s "$work/run.json")" 20 60
awk -F, -v left="$left" -v clear="$(in_json clearance_s "$work/run.json")" 'NR==1 {for (i=1; i<=NF; i++) if ($i=="left") c=i; next} $c==left && !first {first=$1} END {exit !($c==left && first>=clear && first<=clear+0.55)}' "$out/danger.csv"; verdict "danger.csv has the same clearance time" $?

# Without clearance: no clearance time while people are inside.
"$JOSTLE" run scenes/evacuation.yaml --for 20 --quiet --no-half-step --report "$work/early" --summary "$work/early.json" >/dev/null 2>&1
inside=$(sed -n 's/.*"inside": \([0-9]*\).*/\1/p' "$work/early.json")
[ "$(in_json agents "$work/early.json")" = "$inside" ] && [ "$inside" -gt 0 ] && [ "$(in_json left "$work/early.json")" -gt 0 ]; verdict "people still inside are counted ($inside)" $?
grep -q '"clearance_s": null' "$work/early.json"; verdict "without clearance the time is null" $?
between "the time of the last person who left is given" "$(in_json last_left_s "$work/early.json")" 10 20
grep -q "clearance time.*<td class=n>not cleared" "$work/early/index.html" && grep -q "<b>Cleared?</b> No. $inside people were still inside at 20.0 s" "$work/early/index.html"; verdict "the page says: not cleared" $?

# The greatest density is one figure, with a report or without.
"$JOSTLE" run scenes/evacuation.yaml --for 60 --quiet --summary "$work/bare.json" 2>/dev/null
between "density_max is that of the whole run, not of its empty end" "$(figure density_max <"$work/bare.json")" 0.5 10
[ "$(figure density_max <"$work/bare.json")" = "$(figure density_max <"$work/run.json")" ]; verdict "the greatest density does not depend on a report" $?

# A report does not change the run, and its second run can be left out.
same_hash "a report does not change the hash" "$(figure hash <"$work/run.json")" "$(hash_of "$JOSTLE" scenes/evacuation.yaml --for 60)"
"$JOSTLE" run scenes/evacuation.yaml --for 5 --report "$work/once" --no-half-step >/dev/null 2>"$work/err"
! grep -q "half the step" "$work/err" && grep -q "not repeated at half the step: --no-half-step was given" "$work/once/index.html" && ! grep -q "difference<" "$work/once/index.html"; verdict "--no-half-step leaves it out, and the page says so" $?
"$JOSTLE" run scenes/circle.yaml --for 1 --dt 0.0015 --quiet --report "$work/fine" >/dev/null 2>&1
grep -q "not repeated at half the step: it would be below 0.001 s" "$work/fine/index.html"; verdict "the page says if the step cannot be halved" $?
for threads in 1 3; do "$JOSTLE" run scenes/evacuation.yaml --for 30 --quiet --threads $threads --data "$work/data$threads" --summary - 2>/dev/null | sed -n '/"danger"/,/^ }/p' >"$work/danger.$threads"; done
cmp -s "$work/danger.1" "$work/danger.3" && [ -s "$work/danger.1" ] && cmp -s "$work/data1/danger.csv" "$work/data3/danger.csv"; verdict "danger does not depend on threads" $?
[ ! -e "$work/data1/danger.png" ] && [ ! -e "$work/data1/index.html" ]; verdict "--data draws nothing" $?

# Titles are escaped.
printf 'jostle: 1\ntitle: "<script>x</script> \\"quoted\\" & so on"\nduration: 1\ngroups: {g: {behaviour: stander, at: [[0, 0]]}}\n' >"$work/odd.yaml"
"$JOSTLE" run "$work/odd.yaml" --quiet --report "$work/odd" >/dev/null 2>&1 && ! grep -q '<script' "$work/odd/index.html" && grep -q '&lt;script&gt;' "$work/odd/index.html"; verdict "titles are escaped" $?

# People do not pass walls of files and of recordings.
mkdir "$work/hall"
echo 'POLYGON ((0 0, 8 0, 8 6, 0 6, 0 0), (3 2, 5 2, 5 4, 3 4, 3 2))' >"$work/hall/plan.wkt"
walled() { # NAME WALLS: runs a scene whose people want to go outside
    printf 'jostle: 1\nduration: 8\nplaces:\n  room: {polygon: [[0.4, 0.4], [7.6, 0.4], [7.6, 1.6], [0.4, 1.6]]}\n  away: {point: [4, 30], radius: 1}\nwalls: [%s]\ngroups: {g: {behaviour: walker.lua, count: 12, in: room, set: {goal: away}}}\nprobes: {out: {flow: [[-40, 6.2], [40, 6.2]]}, hole: {measure: [[3.1, 2.1], [4.9, 2.1], [4.9, 3.9], [3.1, 3.9]]}}\n' "$2" >"$work/hall/$1.yaml"
    "$JOSTLE" run "$work/hall/$1.yaml" --quiet --record "$work/hall/$1.sqlite" --summary "$work/hall/$1.json" >/dev/null 2>&1
}
crossed() { echo "$(in_json passages "$work/hall/$1.json") $(in_json intervals "$work/hall/$1.json")"; } # prints crossings of the outer wall, and intervals with people in the hole
walled none ''; walled plan '{file: plan.wkt}'; walled again '{file: plan.sqlite}'
[ "$(crossed plan)" = "0 0" ] && [ "$(crossed none)" != "0 0" ] && [ "$(in_json intervals "$work/hall/none.json")" -gt 0 ]; verdict "nobody walks through walls of well-known text ($(crossed none) without)" $?
grep -aq 'POLYGON ((0 0, 8 0, 8 6, 0 6, 0 0), (3 2, 5 2, 5 4, 3 4, 3 2))' "$work/hall/plan.sqlite"; verdict "a recording has the plan's own outline for its walkable area" $?
grep -aq 'POLYGON ((0 0, 8 0, 8 6, 0 6, 0 0), (3 2, 5 2, 5 4, 3 4, 3 2))' "$work/hall/again.sqlite"; verdict "a scene with these walls keeps the outline in its recording" $?
! grep -aq 'POLYGON ((0 0, 8 0' "$work/hall/none.sqlite"; verdict "without a plan the walkable area is the bounding box" $?
grep -q "$(sha256sum "$work/hall/plan.wkt" | cut -c1-64)" "$work/hall/plan.json"; verdict "the plan is an input, with its hash" $?
[ "$(in_json intervals "$work/hall/again.json")" = 0 ]; verdict "nobody walks through the solid walls of a recording" $?
echo 'POLYGON ((0 0, 8 0, 8 6, 0 6))' >"$work/hall/plan.wkt"
"$JOSTLE" check "$work/hall/plan.yaml" >"$work/out" 2>&1; [ $? = 1 ] || [ $? = 3 ]; grep -q 'plan.wkt:1:10: this ring does not end where it begins' "$work/out"; verdict "an error in a plan has its line and column" $?

# Crowd pressure: none in a free boarding queue, far below that of turbulence for people who leave a hall, that of
# turbulence in a crush at a bottleneck.
shaken() { "$JOSTLE" run "scenes/$1.yaml" --for "$2" --quiet --data "$work/shaken" --summary "$work/shaken.json" >/dev/null 2>&1; in_json pressure_max "$work/shaken.json"; }
[ -z "$(shaken station 60)" ] && grep -q '"pressure_max": null' "$work/shaken.json" && grep -q '"pressure_002": {"people": null' "$work/shaken.json"; verdict "crowd pressure of a boarding queue is not measured" $?
between "crowd pressure of 1,000 people who leave by four doors, 1/s2" "$(shaken imo-09 30)" 0.001 0.02
between "crowd pressure of 1,000 people who press through a bottleneck, 1/s2" "$(shaken two-bottlenecks 80)" 0.01 1

# Congestion: 50 people before a door of 1 m, and people who walk freely.
door='  room: {polygon: [[0.3, 0.3], [7.7, 0.3], [7.7, 4.7], [0.3, 4.7]]}'
{
    printf 'jostle: 1\nseed: 3\nduration: 60\nplaces:\n%s\n  outside: {polygon: [[11, 0], [12, 0], [12, 5], [11, 5]]}\n' "$door"
    printf 'walls: [{line: [[8, 2], [8, 0], [0, 0], [0, 5], [8, 5], [8, 3]]}]\n'
    printf 'groups: {people: {behaviour: walker.lua, count: 50, in: room, set: {goal: outside}}}\nprobes: {exit: {flow: [[8, 3], [8, 2]], from: 10}}\n'
} >"$work/jam.yaml"
"$JOSTLE" run "$work/jam.yaml" --no-half-step --report "$work/jam" --summary "$work/jam.json" >"$work/jam.out" 2>&1
jam=$(grep -o '"congestion": {.*' "$work/jam.json")
grep -q '"cleared": true, "regions": [12],' <<<"$jam"; verdict "50 people before a door of 1 m: congestion before the door, or on both sides of it" $?
between "duration of the congestion, s" "$(sed 's/.*"where": \[{"seconds": \([^,]*\).*/\1/' <<<"$jam")" 8 14
between "position of the congestion before the door, m" "$(sed 's/.*"where": .*"x": \([^,]*\), "y".*/\1/' <<<"$jam")" 6 8
grep -q '<b>Congestion\.</b> Significant: above 4 per m.* (Gaussian, R = 1 m) .* m from the line exit' "$work/jam/index.html"; verdict "the page says where the congestion is" $?
grep -q 'stood in a density of [57] per m² (Gaussian, R = 1 m) or more. The greatest Voronoi density of a person (cell within 1 m) was' "$work/jam/index.html"; verdict "the page says how densities are measured, and gives both kinds" $?
[ "$(wc -l <"$work/jam/danger-congestion.csv")" = $(($(sed 's/.*"regions": \([0-9]*\),.*/\1/' <<<"$jam") + 1)) ]; verdict "danger-congestion.csv has the same regions" $?
grep -q 'exit (1.00 m wide): 50 crossings from 0 s on (its probe has [0-9]*: from 10 s on, one way, net' "$work/jam/index.html" && grep -q '"from": 10, "until": null' "$work/jam.json" && grep -q '"from_s": 0, "forward": 50' "$work/jam.json"; verdict "two counts of one line say when each begins" $?
grep -q '"queue_growth_max": 0,' "$work/jam.json"; verdict "the queue of the exit never grew" $?
{ cat "$work/jam.yaml"; echo 'forces: {enabled: false}'; } >"$work/deep.yaml" # nothing keeps bodies apart
"$JOSTLE" run "$work/deep.yaml" --no-half-step --report "$work/deep" --summary "$work/deep.json" >"$work/deep.out" 2>&1
tr -s ' \n' ' ' <"$work/deep.out" | grep -q 'are not to be trusted where it is dense: bodies overlap by [0-9]* % of their depth' && grep -q '<b>Too dense to trust.</b>' "$work/deep/index.html" && grep -q '"holds": false' "$work/deep.json"; verdict "overlaps are reported in the last lines, the page and the summary" $?
"$JOSTLE" run scenes/families.yaml --for 20 --summary "$work/loose.json" >"$work/loose.out" 2>&1
! grep -q 'trusted' "$work/loose.out" && grep -q '"holds": true' "$work/loose.json"; verdict "no such report if nobody is pressed" $?
"$JOSTLE" run scenes/corridor.yaml --for 15 --quiet --data "$work/free" --summary "$work/free.json" >/dev/null 2>&1
grep -q '"cleared": false, "regions": 0, "area": 0, "longest_s": 0,' "$work/free.json"; verdict "people who walk freely: no congestion" $?

# Each figure has the same value in the summary, in the tables and on the page.
"$JOSTLE" run scenes/door-050.yaml --for 40 --quiet --no-half-step --report "$work/door" --summary "$work/door.json" >/dev/null 2>&1
verdict "a run through a door" $?
sed -n '/^ "danger"/,/^ }/p' "$work/door.json" >"$work/door.danger"
column() { awk -F, -v name="$1" 'NR == 1 {for (i = 1; i <= NF; i++) if ($i == name) c = i; next} c && $c != "" && $c != "nan" {print $c}' "$2"; } # NAME FILE
greatest() { column "$1" "$2" | sort -g | tail -1; }
# cells TABLE FIRST-CELL: prints the other cells of a row of a table of the page, from its file, one per line
cells() { python3 -c 'import csv, sys; [print("\n".join(row[1:])) for row in csv.reader(open(sys.argv[1])) if row[0] == sys.argv[2]]' "$work/door/table-$1.csv" "$2"; }
alike() { # NAME A B WITHIN: checks that A = B within the share WITHIN, or that both are empty
    awk -v a="$2" -v b="$3" -v d="$4" 'BEGIN {e = a - b; m = a < 0 ? -a : a; exit !(a == b || (a != "" && b != "" && e <= d * m && -e <= d * m))}'
    verdict "$1 ($2, $3)" $?
}
[ -n "$(figure density_max <"$work/door.json")" ] && [ "$(figure density_max <"$work/door.json")" = "$(in_json density_max "$work/door.danger")" ]; verdict "density_max of the run is that of its danger figures" $?
for table in danger.csv danger-map.csv; do
    alike "a crush: crowd pressure of $table is that of the summary" "$(in_json pressure_max "$work/shaken.json")" "$(greatest 'pressure_max [1/s2]' "$work/shaken/$table")" 1e-6
done
for measure in density:1/m2:"density (Gaussian, R = 1 m)" pressure:1/s2:"crowd pressure" compression:N/m:compression load:N:"load from one side"; do
    IFS=: read -r name unit title <<<"$measure"
    said=$(in_json "${name}_max" "$work/door.danger")
    alike "the greatest $name over time is that of the summary" "$said" "$(greatest "${name}_max [$unit]" "$work/door/danger.csv")" 1e-6
    alike "the greatest $name of the map is that of the summary" "$said" "$(greatest "${name}_max [$unit]" "$work/door/danger-map.csv")" 1e-3
    alike "the greatest $name on the page is that of the summary" "$said" "$(cells greatest "$title" | sed -n 1p)" 1e-6
done
# A recording holds the walls too; positions rounded to 0.1 mm are the only difference.
"$JOSTLE" run scenes/evacuation.yaml --for 40 --quiet --record "$work/rooms.sqlite" --summary "$work/rooms.json" >/dev/null 2>&1
"$JOSTLE" report "$work/rooms.sqlite" --out "$work/rooms" --summary "$work/again.json" >/dev/null 2>&1
alike "the greatest density of a run, and of its recording" "$(figure density_max <"$work/rooms.json")" "$(in_json density_max "$work/again.json")" 0.01
alike "the greatest density of the summary and of its danger" "$(figure density_max <"$work/door.json")" "$(in_json density_max "$work/door.danger")" 1e-6
alike "the greatest dose over time is that of the summary" "$(in_json dose_max "$work/door.danger")" "$(greatest 'dose_max' "$work/door/danger.csv")" 1e-6
for limit in density_5:"density of 5 per m² (Gaussian, R = 1 m)" density_7:"density of 7 per m² (Gaussian, R = 1 m)" voronoi_5:"Voronoi density of 5 per m²" voronoi_7:"Voronoi density of 7 per m²" pressure_002:"crowd pressure of 0.02 per s²" load_623:"load of 623 N" load_1112:"load of 1112 N" load_6227:"load of 6227 N" dose_1:"dose of load of 1"; do
    IFS=: read -r limit title <<<"$limit"
    object=$(grep -o "\"$limit\": {[^}]*}" "$work/door.danger")
    line=$(grep "^$limit," "$work/door/danger-limits.csv")
    n=5
    for key in people person_s longest_s first_s first_x first_y since_min; do
        want=$(sed "s/.*\"$key\": \([^,}]*\).*/\1/; s/null//" <<<"$object")
        alike "$limit: $key" "$want" "$(cut -d, -f$n <<<"$line")" 1e-6
        n=$((n + 1))
    done
    page=$(cells limits "$title")
    alike "$limit on the page: people" "$(cut -d, -f5 <<<"$line")" "$(sed -n 1p <<<"$page")" 1e-6
    alike "$limit on the page: person-seconds" "$(cut -d, -f6 <<<"$line")" "$(sed -n 2p <<<"$page")" 1e-6
    alike "$limit on the page: longest" "$(cut -d, -f7 <<<"$line")" "$(sed -n 3p <<<"$page")" 1e-6
done
total=0
for level in A B C D E F; do
    said=$(grep -o '"level_person_s": {[^}]*}' "$work/door.danger" | sed "s/.*\"$level\": \([^,}]*\).*/\1/")
    alike "level $level: person-seconds in the table" "$said" "$(grep "^$level," "$work/door/danger-levels.csv" | cut -d, -f3)" 1e-6
    alike "level $level: person-seconds on the page" "$said" "$(cells levels $level | sed -n 2p)" 1e-6
    total=$(awk -v a="$total" -v b="$said" 'BEGIN {print a + b}')
done
alike "person-seconds of all levels sum to those of the people over time" "$total" "$(awk -F, 'NR == 1 {for (i = 1; i <= NF; i++) if ($i == "level_A") c = i} NR > 2 {for (k = c; k < c + 6; k++) s += $k * ($1 - t)} {t = $1} END {print s}' "$work/door/danger.csv")" 1e-6
door=$(sed -n 's/.*"lines": {"door": \(.*\)/\1/p' "$work/door.danger")
alike "the width of the line is that of the opening, 0.8 m" "$(sed 's/.*"width": \([^,]*\).*/\1/' <<<"$door")" 0.8 0.03
alike "crossings of the line are the passages of the probe" "$(sed 's/.*"forward": \([^,]*\).*/\1/' <<<"$door")" "$(column forward "$work/door/danger-lines.csv" | tail -1)" 0
alike "the greatest flow of the line is that of its table" "$(sed 's/.*"flow_max": \([^,]*\).*/\1/' <<<"$door")" "$(greatest 'flow [1/(m s)]' "$work/door/danger-lines.csv")" 1e-6
alike "the greatest flow of the line on the page is that of the summary" "$(sed 's/.*"flow_max": \([^,]*\).*/\1/' <<<"$door")" "$(cells lines door | sed -n 1p)" 1e-6
stops=$(column stop_and_go "$work/door/danger-lines.csv" | grep -c 1)
alike "seconds of stop-and-go at the line are those of its table" "$(sed 's/.*"stop_and_go": {"seconds": \([^,]*\).*/\1/' <<<"$door")" "$(awk -v n="$stops" 'BEGIN {print n / 2}')" 1e-6

# Nothing seen in a region: the report says so, and does not fail.
expect "a run that ends before regions are sampled has a report" 0 "report:" "$JOSTLE" run scenes/tawaf.yaml --set groups.pilgrims.count=40 --set sources.0.keep=40 --for 1 --no-half-step --report "$work/soon"
grep -q "Mean speed of the regions: nothing was measured" "$work/soon/index.html" && [ ! -e "$work/soon/regions.png" ] && grep -q '^R1,,0$' "$work/soon/regions.csv"; verdict "  that says that nothing was measured" $?
