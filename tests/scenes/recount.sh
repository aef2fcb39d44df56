# Figures of a report, counted again from the recording of the same run by a script that shares no code with it.
. tests/scenes/lib.sh
python=$(command -v /usr/bin/python3 || command -v python3) # Debian's has numpy
mkdir -p "$work/scenes" && cp -r behaviours scripts "$work/"
sed 's/^probes:/&\n  corner: {measure: [[13, 0], [15.8, 0], [15.8, 4], [13, 4]], every: 0.5, cutoff: 1}/' scenes/evacuation.yaml >"$work/scenes/evacuation.yaml"
"$JOSTLE" run "$work/scenes/evacuation.yaml" --for 60 --quiet --no-half-step --record "$work/run.sqlite" --record-every 0.05 --report "$work/page" >/dev/null 2>&1
verdict "a run with a report and a recording" $?
"$python" tests/scenes/recount.py "$work/run.sqlite" "$work/page"
# The null: with a person taken out of the recording, the counts must differ.
"$python" tests/scenes/recount.py "$work/run.sqlite" "$work/page" --drop 7 >"$work/out"
[ $? = 1 ] && grep -q "^not ok people who left (recounted 139, reported 140" "$work/out" && grep -q "^not ok crossings of" "$work/out"; verdict "a recording that lacks a person does not pass" $?
# Another wrong count: of densities by another radius.
"$python" tests/scenes/recount.py "$work/run.sqlite" "$work/page" --radius 1.3 >"$work/out"
[ $? = 1 ] && [ "$(grep -c "^not ok .*Gaussian" "$work/out")" -ge 1 ]; verdict "a Gaussian of another radius does not pass" $?

# Voronoi densities by scipy's cells: in a corner of the hall, where cells end at walls, and in an even crowd, where they must
# be those of the Gaussian, too.
"$python" tests/scenes/recount_voronoi.py "$work/run.sqlite" "$work/page" corner 13,0,15.8,4 10,0,26,14 30
"$python" tests/scenes/recount_voronoi.py "$work/run.sqlite" "$work/page" corner 13,0,15.8,4 10,0,26,14 5 --cutoff 0.5 >"$work/out"
[ $? = 1 ] && grep -q "^not ok mean Voronoi density" "$work/out"; verdict "cells of another cut-off do not pass" $?
awk 'BEGIN {print "# framerate: 4 fps"; srand(7); for (i = 0; i < 400; i++) {x[i] = (i % 20 + 0.5) * 0.6 + 0.1 * (rand() - 0.5); y[i] = (int(i / 20) + 0.5) * 0.6 + 0.1 * (rand() - 0.5)}
    for (f = 0; f < 12; f++) for (i = 0; i < 400; i++) print i, f, x[i], y[i], 0}' >"$work/even.txt"
printf 'jostle: 1\nprobes: {middle: {measure: [[4, 4], [8, 4], [8, 8], [4, 8]], every: 0.5, cutoff: 1}}\n' >"$work/even.yaml"
"$JOSTLE" report "$work/even.txt" --unit m --scene "$work/even.yaml" --out "$work/even" >/dev/null 2>&1
"$python" tests/scenes/recount_voronoi.py "$work/even.txt" "$work/even" middle 4,4,8,8 0,0,12,12 3 --even

# Tables are rectangular, with a name for each column, and one type in each.
cat >"$work/tables.py" <<'PYTHON'
import csv, glob, re, sys
wrong = []
for path in sorted(glob.glob(sys.argv[1] + "/table-*.csv")):
    with open(path, newline="", encoding="utf-8") as file:
        head, *rows = csv.reader(file)
    if len(set(head)) != len(head) or "" in head or any(len(row) != len(head) for row in rows) or not rows:
        wrong.append(path)
    for name, column in zip(head, zip(*rows)):
        numbers = [bool(re.fullmatch(r"-?[0-9.]+(e[-+]?[0-9]+)?", cell)) for cell in column if cell]
        if numbers and any(numbers) != all(numbers):
            wrong.append(path + ": " + name)
print("ok tables as CSV" if not wrong else "not ok tables as CSV: %s" % wrong)
PYTHON
python3 "$work/tables.py" "$work/page"
