# Recordings as PedPy reads them: the rules of its loader (pedpy/io/trajectory_loader.py: load_trajectory_from_jupedsim_sqlite and
# load_walkable_area_from_jupedsim_sqlite; pedpy/data/geometry.py: WalkableArea), checked without PedPy itself, which no package
# of Debian has. What PedPy computes is not run.
. tests/scenes/lib.sh
"$JOSTLE" run scenes/evacuation.yaml --quiet --for 8 --record "$work/flat.sqlite" >/dev/null 2>&1
"$JOSTLE" run scenes/rimea-13-up.yaml --quiet --for 20 --record "$work/storeys.sqlite" >/dev/null 2>&1
for recording in flat storeys; do
    python3 - "$work/$recording.sqlite" >"$work/check" 2>&1 <<'END'
import math, re, sqlite3, sys
db = sqlite3.connect(sys.argv[1])
rows = db.execute("select frame, id, pos_x as x, pos_y as y from trajectory_data").fetchall()
assert rows, "the trajectory is empty"
assert all(type(f) is int and type(i) is int and type(x) is float and type(y) is float for f, i, x, y in rows)
assert all(math.isfinite(x) and math.isfinite(y) for _, _, x, y in rows)
assert len({(f, i) for f, i, _, _ in rows}) == len(rows), "PedPy joins rows by frame and id"
fps = db.execute("select value from metadata where key = 'fps'").fetchone()
assert fps is not None and float(fps[0]) > 0, fps
assert int(db.execute("SELECT value FROM metadata WHERE key = ?", ("version",)).fetchone()[0]) in (1, 2)
# the walkable area: the union of all geometries is one polygon
areas = [wkt for (wkt,) in db.execute("SELECT wkt FROM geometry")]
assert areas
def rings(wkt):
    name, body = re.fullmatch(r"\s*(POLYGON|MULTIPOLYGON|GEOMETRYCOLLECTION)\s*(\(.*\))\s*", wkt, re.S).groups()
    assert name == "POLYGON" or wkt.count("POLYGON") > 0, wkt
    return [[tuple(map(float, p.split())) for p in r.split(",")] for r in re.findall(r"\(([^()]+)\)", body)]
def area(ring): return sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:])) / 2
def inside(ring, x, y):
    hit = False
    for (ax, ay), (bx, by) in zip(ring, ring[1:]):
        if (ay > y) != (by > y) and x < (bx - ax) * (y - ay) / (by - ay) + ax:
            hit = not hit
    return hit
shapes = [rings(wkt) for wkt in areas]
for shape in shapes:
    for ring in shape:
        assert len(ring) >= 4 and ring[0] == ring[-1] and all(len(p) == 2 for p in ring) and abs(area(ring)) > 0, ring
    assert all(inside(shape[0], *p) or p in shape[0] for hole in shape[1:] for p in hole), "a hole lies outside"
# PedPy leaves out, or refuses, people outside of the walkable area: there are none
out = [(f, i, x, y) for f, i, x, y in rows if not any(inside(s[0], x, y) for s in shapes)]
assert not out, out[:3]
END
    [ ! -s "$work/check" ]; verdict "PedPy's loader reads a recording ($recording)" $?
    cat "$work/check"
done
