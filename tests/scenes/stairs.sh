# Stairs and lifts in reports: the same figures on the page, in its tables and plots, in the summary and from the recording;
# too few people are not judged; positions in plan. Comparisons and sweeps of scenes with storeys.
. tests/scenes/lib.sh
program=$(case $JOSTLE in /*) echo "$JOSTLE" ;; *) echo "$PWD/$JOSTLE" ;; esac)
cd "$work" || exit 1
cat >tower.yaml <<'SCENE'
jostle: 1
title: Tower
duration: 50
storeys: {ground: {height: 0}, first: {height: 4}}
lifts: {east: {area: [[10, 5], [11.6, 6.8]], door: [[10.35, 5], [11.25, 5]]}}
stairs:
  steps: {from: ground, to: first, path: [[8, 1.5], [14, 1.5]], width: 1.2}
  spare: {from: ground, to: first, path: [[8, 10], [14, 10]], width: 1.2}
walls: [{line: [[0, 0], [16, 0], [16, 12], [0, 12]], closed: true, storey: [ground, first]}]
places:
  low: {polygon: [[1, 1], [7, 1], [7, 7], [1, 7]]}
  high: {polygon: [[1, 1], [7, 1], [7, 7], [1, 7]], storey: first}
groups:
  riders: {behaviour: ride.lua, count: 9, in: low}
  walkers: {count: 30, in: low, journey: [{to: high, wait: 200}]}
events: [{at: 49.8, lift: east, mode: out_of_use}, {at: 49.9, push: low, force: [1, 0], lasts: 0.1}]
SCENE
cat >ride.lua <<'LUA'
return machine { name = "rider", version = 1, start = "Ride", defaults = { speed = 1.3 }, states = {
  Ride = { steer = ride "east.first", { to = "Off", when = rode } },
  Off = { steer = seek "high" } } }
LUA

# ---- a report ----
expect "a scene with a stair and a lift has a report" 0 "report:" "$program" run tower.yaml --quiet --no-half-step --report page --summary run.json --record run.sqlite
"$program" report run.sqlite --out again --summary again.json >/dev/null 2>&1
verdict "  and its recording has one" $?
grep -q 'sets the mode of lift east to out_of_use' page/table-events.csv && grep -q 'pushes low by (1, 0) N' page/table-events.csv
verdict "  which says what events did" $?
grep -q '^east.first,door of a lift on first,"(10.35, 5.00)"' page/table-openings.csv
verdict "  and where doors are, in plan" $?
python3 - >check 2>&1 <<'END'
import csv, json
run, again = json.load(open("run.json")), json.load(open("again.json"))
stairs, lift = run["danger"]["stairs"], run["lifts"]["east"]
steps, spare = stairs["steps"], stairs["spare"]
assert steps["up"] + spare["up"] == 30 and steps["down"] + spare["down"] == 0, stairs
assert steps["flow_max"] is not None and steps["up"] >= 10, steps
def table(name): return {row[0]: row for row in csv.reader(open(f"page/table-{name}.csv"))}
heads = next(csv.reader(open("page/table-stairs.csv")))
def cell(stair, head): return table("stairs")[stair][heads.index(head)]
for stair, figures in stairs.items():
    for head, key in (("people up", "up"), ("most people on it at a time", "people_max"), ("greatest flow [1/(m s)]", "flow_max"),
                      ("greatest mean density [1/m2]", "density_mean_max"), ("time of use [s]", "used_s")):
        shown, known = cell(stair, head), figures[key]
        assert (shown == "") == (known is None) and (known is None or abs(float(shown) - known) < 1e-6 * max(1, known)), (stair, head, shown, known)
    assert (cell(stair, "worst level") == "not judged") == (figures["worst_level"] is None), (stair, figures)
rows = [r for r in csv.DictReader(open("page/danger-stairs.csv")) if r["stair"] == "steps"]
assert abs(max(float(r["flow [1/(m s)]"] or 0) for r in rows) - steps["flow_max"]) < 1e-6
assert int(rows[-1]["up"]) == steps["up"]
# recounted: at the moment of the greatest flow, people who came up within the ten seconds before, per metre
at = steps["flow_max_s"]
ups = {float(r["time [s]"]): int(r["up"]) + int(r["down"]) for r in rows}
assert abs((ups[at] - ups[min(ups, key=lambda t: abs(t - (at - 10)))]) / 12 - steps["flow_max"]) < 1.01 / 12, (at, steps)
lifts = next(csv.DictReader(open("page/table-lifts.csv")))
for head, key in (("people carried", "carried"), ("trips", "trips"), ("mean wait [s]", "wait_mean_s"), ("longest wait [s]", "wait_max_s"),
                  ("most people waiting at a time", "queue_max")):
    assert abs(float(lifts[head]) - lift[key]) < 1e-6, (head, lifts, lift)
assert lift["carried"] == 9 and run["danger"]["by_lift"] == {"up": 9, "down": 0}, (lift, run["danger"]["by_lift"])
queue = max(int(r["waiting"]) for r in csv.DictReader(open("page/danger-lifts.csv")))
assert lift["queue_max"] - 2 <= queue <= lift["queue_max"], (queue, lift)
# from the recording, whose frames are tenths of a second
other = again["danger"]["stairs"]["steps"]
for key, within in (("up", 0), ("down", 0), ("people_max", 1), ("flow_max", 0.09), ("density_mean_max", 0.1), ("used_s", 1)):
    assert abs(other[key] - steps[key]) <= within, (key, other[key], steps[key])
assert again["danger"]["by_lift"] == run["danger"]["by_lift"]
# positions in plan, with their storey
for name in ("danger-walls", "paths"):
    for row in csv.DictReader(open(f"page/{name}.csv")):
        assert row["storey"] in ("ground", "first", "steps", "spare"), row
        assert -0.5 <= float(row["y [m]" if name == "paths" else "y0 [m]"]) <= 12.5, row
END
[ ! -s check ]; verdict "summary, tables and recording have the same figures of stairs and lifts" $?
cat check
for file in stairs.png stairs.svg lifts.png lifts.svg; do [ -s "page/$file" ]; verdict "  the report's $file" $?; done
for text in "<b>Stairs.</b> The densest was " "<b>Lifts.</b> east carried 9 people, who waited " "Flow and level are not judged where fewer than 10 people passed: " "Too few people for means, fewer than ten, rode: east."; do
    grep -qF "$text" page/index.html; verdict "the page has: $text" $?
done
grep -qF "9 people went up and 0 people down without a stair, by lift. Waits are not measured" again/index.html; verdict "the page of a recording says that waits are not known" $?

# ---- sweeps and comparisons ----
"$program" sweep tower.yaml --set groups.walkers.count=6,40 --seeds 2 --for 25 --out walkers.sqlite --quiet >/dev/null 2>&1
verdict "a scene with storeys is swept" $?
expect "  and its variants are compared" 0 "greatest mean density on the stair steps" "$program" compare walkers.sqlite --all --out compared --json compared.json
python3 - >check 2>&1 <<'END'
import json, re, sqlite3, array, math
d = json.load(open("compared.json"))
for name in ("danger.stairs.steps.up", "danger.stairs.steps.flow_max", "lifts.east.carried", "lifts.east.queue_max"):
    assert name in d["figures"], name
assert d["figures"]["danger.stairs.steps.up"]["sides"][1]["difference"] > 0
# each storey has a panel of its own, and the difference too
for file in ("plan-2", "change-2"):
    svg = open(f"compared/{file}.svg").read()
    assert svg.count('class="storey"') == 2 and 'id="stairs"' in svg and 'id="field"' in svg, file
assert not __import__("os").path.exists("compared/change-1.svg")
# the people whom a field holds are those who were there: integral of the mean density over the floor
db = sqlite3.connect("walkers.sqlite")
for variant, people in ((0, 15), (1, 49)):
    key = db.execute("select distinct variant from field order by variant").fetchall()[variant][0]
    cell, cells = db.execute("select cell, cells from field where variant = ? and name = 'mean density'", (key,)).fetchone()
    held = sum(v for v in array.array("f", cells) if not math.isnan(v)) * cell * cell
    assert abs(held - people) < 0.06 * people, (held, people)
END
[ ! -s check ]; verdict "figures, panels and differences of both storeys" $?
cat check
"$program" sweep tower.yaml --set groups.walkers.count=20 --seeds 2 --for 15 --out seeds.sqlite --quiet >/dev/null 2>&1
"$program" report seeds.sqlite --out seeds >/dev/null 2>&1
[ "$(grep -c 'class="storey"' seeds/density-greatest.svg)" = 2 ]; verdict "the page of many seeds has a panel for each storey" $?
for n in 6 20; do "$program" run tower.yaml --quiet --for 15 --set groups.walkers.count=$n --record "w$n.sqlite" >/dev/null 2>&1; done
"$program" compare w6.sqlite w20.sqlite --out recordings >/dev/null 2>&1
[ "$(grep -c 'class="storey"' recordings/plan-2.svg)" = 2 ]; verdict "a comparison of recordings, too" $?
mkdir mixed; cp w6.sqlite mixed/a.sqlite
sed 's/\[0, 12\]\]/[0, 60]]/; s/\[16, 12\]/[16, 60]/' tower.yaml >deep.yaml
"$program" run deep.yaml --quiet --for 2 --record mixed/b.sqlite >/dev/null 2>&1
expect "recordings of two buildings are not one side" 3 "has other storeys than" "$program" compare w6.sqlite mixed --out mixed-page
[ "$(cat compared/plan-*.svg compared/change-2.svg | grep -c '>most people per m² (Gaussian, R = 1 m)<\|>change of most people per m²<')" = 3 ]
verdict "legends of plans and differences have room" $?

# ---- people who cannot use stairs ----
cat >wheels.yaml <<'END'
jostle: 1
duration: 20
storeys: {ground: {height: 0}, first: {height: 4}, second: {height: 8}}
stairs:
  lower: {from: ground, to: first, path: [[2, 8], [9, 8]]}
  upper: {from: first, to: second, path: [[2, 12], [9, 12]]}
lifts: {east: {area: [[20, 5], [21.8, 6.8]], door: [[20.4, 5], [21.4, 5]], mode: out_of_use}}
walls: [{line: [[0, 0], [26, 0], [26, 15], [0, 15]], closed: true, storey: [ground, first, second]}]
places:
  low: {point: [4, 1.5], radius: 1}
  lobby: {polygon: [[23, 1], [25, 1], [25, 3], [23, 3]], storey: first, refuge: true}
  rooms: {polygon: [[12, 1], [19, 1], [19, 4], [12, 4]], storey: first}
  high: {polygon: [[12, 1], [19, 1], [19, 4], [12, 4]], storey: second}
groups:
  below: {count: 3, fill: random, in: rooms, set: {lifts: only}, journey: [{exit: low}]}
  above: {count: 2, fill: random, in: high, set: {lifts: only}, journey: [{exit: low}]}
  walkers: {count: 5, fill: random, in: high, journey: [{exit: low}]}
events: [{at: 100, lift: east, mode: firemen}]
END
"$program" run wheels.yaml --quiet --report wheels --summary wheels.json >/dev/null 2>&1
grep -qF 'On first: 3 stay in a refuge, as no lift takes them. On second: 2 stay with neither a lift' wheels/index.html
verdict "a report tells where people who cannot use stairs stay" $?
sed '/^  above:/d; /^events:/d' wheels.yaml >refuge.yaml
"$program" run refuge.yaml --quiet >refuge.out 2>&1 && [ ! -s refuge.out ]
verdict "  and those who wait in a refuge are no fault of a scene" $?
grep -A9 '"cannot_use_stairs"' wheels.json | tr -d ' \n' | grep -qF '"in_refuge":3,"without_refuge":2,"on_stairs":0,"storeys":{"first":{"in_refuge":3'
verdict "  and so does the summary" $?
"$program" run wheels.yaml --quiet --seeds 2 --report many >/dev/null 2>&1
grep -qF 'In 2 of 2 runs people stayed in a refuge, as no lift takes them: 3 people (on first at most 3).' many/index.html
verdict "  and the page of many seeds" $?
