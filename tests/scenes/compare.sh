# jostle compare: differences with intervals, paired by seed; sides that the runs do not tell apart, and how many seeds
# would; percentiles; pages of sweeps, scenes and recordings; wrong arguments.
. tests/scenes/lib.sh
root=$PWD
program=$(case $JOSTLE in /*) echo "$JOSTLE" ;; *) echo "$PWD/$JOSTLE" ;; esac)
# json NAME EXPRESSION...: evaluates Python expressions on the JSON, as d
json() { python3 -c "import json, sys, math; d = json.load(open('$1')); print($2)"; }
cd "$work" || exit 1
scene=$root/scenes/evacuation.yaml
"$program" sweep "$scene" --set groups.hall.count=30,90 --set groups.archive.count=2 --set groups.office.count=20 --seeds 4 --for 12 --out halls.sqlite --csv halls.csv --quiet

# ---- the same figures computed independently from the CSV table ----
expect "compare prints a comparison" 0 "Student's t of the differences of 4 seeds" "$program" compare halls.sqlite --out page --json c.json --percentile 75
python3 - >check 2>&1 <<'END'
import csv, json, math
rows = list(csv.DictReader(open("halls.csv")))
d = json.load(open("c.json"))
a, b = ([float(r["density_max"]) for r in rows if r["groups.hall.count"] == n] for n in ("30", "90"))
diff = [y - x for x, y in zip(a, b)]
mean = sum(diff) / 4
half = 3.18245 * math.sqrt(sum((x - mean) ** 2 for x in diff) / 3 / 4) # t of 3 degrees, 95 %
side = d["figures"]["density_max"]["sides"][1]
assert abs(side["difference"] - mean) < 1e-6 and abs(side["low"] - (mean - half)) < 1e-4 and abs(side["high"] - (mean + half)) < 1e-4, (side, mean, half)
assert side["pairs"] == 4 and side["method"].startswith("Student's t of the differences of 4 seeds")
assert side["worst"] == max(b) and side["percentile"] == max(b) and side["percentile_bound"] is None, side
assert d["sides"][0]["seeds"] == [1, 2, 3, 4] and d["sides"][1]["name"] == "count=90"
assert d["figures"]["agents"]["sides"][1]["verdict"] == "differs"
assert not any(n.endswith("_person") or n.startswith("stage_ns") or n == "cpu_s" for n in d["figures"])
END
[ ! -s check ]; verdict "JSON and table have the same interval" $?
cat check
grep -q '^count=90 minus count=30:' "$work/out"; verdict "variants are named by what differs" $?
grep -q 'seeds would tell a difference of this size' "$work/out"; verdict "the output says that seeds are few, and how many are needed" $?
grep -q 'takes 11 runs' "$work/out"; verdict "a bound of a percentile says how many runs it needs" $?
expect "--bootstrap computes intervals by resampling" 0 "bootstrap of the differences of 4 seeds, 2000 resamples" "$program" compare halls.sqlite --bootstrap 2000
"$program" sweep "$scene" --set groups.hall.count=90 --set groups.archive.count=2 --set groups.office.count=20 --seeds 3 --seed 50 --for 12 --out others.sqlite --quiet
expect "seeds that are not shared are not paired" 0 "Welch's t of 4 and 3 runs" "$program" compare halls.sqlite others.sqlite --base 1
grep -q '^ 3  others: 3 runs, seeds 50 to 52' "$work/out"; verdict "  sides are named by their files" $?
expect "--label names sides" 0 "as it is minus fewer:" "$program" compare halls.sqlite --label fewer --label "as it is"
expect "  more labels than sides are refused" 2 "there are 3 labels, and 2 sides" "$program" compare halls.sqlite --label a --label b --label c
expect "--base chooses the base" 0 "minus halls: count=90:" "$program" compare halls.sqlite others.sqlite --base "halls: count=90"

# ---- the page ----
for file in index.html compare.plt effects.svg curve-1.svg plan-1.svg plan-2.svg; do [ -s "page/$file" ]; verdict "  the page's $file" $?; done
grep -q '<div class=summary>' page/index.html && grep -q 'greatest density of any place and time' page/index.html; verdict "the page has sentences on figures" $?
grep -q 'too few runs to tell these apart' page/index.html; verdict "  also on figures for which the seeds do not decide" $?
for id in walls field; do grep -q "id=\"$id\"" page/plan-2.svg; verdict "  a plan has $id" $?; done

# ---- scenes and recordings ----
expect "scenes are run with seeds before the comparison" 0 "minus evacuation:" "$program" compare "$scene" "$root/scenes/two-exits.yaml" --seeds 2 --for 3 --out scenes --quiet
[ "$(sqlite3 scenes/two-exits.sqlite 'select count(*) from run')" = 2 ]; verdict "  and the runs are kept" $?
expect "  and --out must name their folder" 2 "where the runs of scenes are kept" "$program" compare "$scene"
for n in 1 2; do "$program" run "$scene" --quiet --seed $n --for 4 --record "r$n.sqlite"; done
expect "a comparison of recordings has no interval" 0 "one run: not known how sure" "$program" compare r1.sqlite r2.sqlite --scene "$scene" --out recordings
[ -s recordings/curve-1.svg ] && [ -s recordings/plan-2.svg ]; verdict "  but curves and plans" $?
mkdir before after
for n in 1 2 3; do
    "$program" run "$scene" --quiet --seed $n --for 4 --record "before/$n.sqlite"
    "$program" run "$scene" --quiet --seed $n --for 4 --record "after/$n.sqlite" --set groups.hall.count=40
done
expect "a folder of recordings is one side" 0 "3 recordings" "$program" compare before after/ --scene "$scene" --out folders --json folders.json
[ "$(json folders.json '[s["runs"] for s in d["sides"]], d["figures"]["people"]["sides"][1]["verdict"], d["figures"]["people"]["sides"][1]["method"]')" = "[3, 3] differs Welch's t of 3 and 3 runs" ]; verdict "  and its recordings give an interval" $?
[ -s folders/curve-1.svg ] && [ -s folders/plan-2.svg ]; verdict "  and curves with bands" $?
mkdir nothing
expect "a folder without recordings is refused" 3 "has no recordings" "$program" compare before nothing
"$program" sweep "$scene" --seeds 1 --for 4 --out one.sqlite --quiet
expect "one run has no interval either" 0 "one run: not known how sure" "$program" compare one.sqlite r2.sqlite --scene "$scene"

# ---- errors ----
expect "a comparison without sides is refused" 2 "no side given" "$program" compare
expect "a side that does not exist is refused" 3 "gone.yaml" "$program" compare halls.sqlite gone.yaml --out x
echo "nothing of the kind" >text.txt
expect "a text that is no recording is refused" 3 "text.txt" "$program" compare text.txt
expect "a base that is no side is refused" 2 "there are 'count=30', 'count=90'" "$program" compare halls.sqlite --base 7
cp halls.sqlite damaged.sqlite; dd if=/dev/urandom of=damaged.sqlite bs=4096 seek=2 count=60 conv=notrunc 2>/dev/null
expect "a damaged file of a sweep is refused" 3 "damaged.sqlite" "$program" compare damaged.sqlite
expect "an unwritable page is an error" 1 "cannot make the folder '/proc/x'" "$program" compare halls.sqlite --out /proc/x
cp halls.sqlite large.sqlite
sqlite3 large.sqlite "with recursive n(k) as (select 1 union all select k + 1 from n where k < 20000) insert into curve_point select variant, seed, 1, 1000 + k, k from n, run"
expect "a large file is read without temporary files" 0 "Student's t of the differences of 4 seeds" "$program" compare large.sqlite
sqlite3 halls.sqlite "update field set columns = 99999999, rows = 99999999; update figure set value = 'text' where seed = 2; update variant set plan = '{\"area\": [0, 0, 1e300, 2]}'; update run set summary = NULL"
expect "numbers that are not finite are left out" 0 "density" "$program" compare halls.sqlite --out hostile
