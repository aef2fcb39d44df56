"""Counts Voronoi densities again from a recording, by scipy's Voronoi cells, and compares them with those of a report's probe
and with the report's Gaussian density where both must agree, in an even crowd.
`recount_voronoi.py RECORDING REPORT-FOLDER PROBE AREA FLOOR UNTIL [--cutoff METRES] [--even]`; AREA and FLOOR are rectangles
"x,y,x,y" in m, the floor convex and walled. The density of an area is the sum over people of the share of their cell that lies
in it, over its size (Steffen and Seyfried 2010; PedPy's voronoi_polygons with cut-off); cells end at the floor's edge."""
import csv, math, os, sqlite3, sys
import numpy as np
from scipy.spatial import Voronoi

recording, folder, probe, area, floor, until = sys.argv[1:7]
cutoff = float(sys.argv[sys.argv.index("--cutoff") + 1]) if "--cutoff" in sys.argv else 1.0  # m
CORNERS = 64  # of the polygon in place of the circle of the cut-off
failures = 0

def near(name, ours, theirs, within):
    global failures
    good = abs(ours - theirs) <= within
    failures += not good
    print("%s %s (recounted %.4g, reported %.4g, within %.3g)" % ("ok" if good else "not ok", name, ours, theirs, within))

def rectangle(text):
    left, low, right, high = map(float, text.split(","))
    return np.array([(left, low), (right, low), (right, high), (left, high)])

def clip(polygon, by):
    """Returns the part of a convex polygon within another, both anti-clockwise (Sutherland and Hodgman)."""
    for a, b in zip(by, np.roll(by, -1, axis=0)):
        if len(polygon) == 0:
            break
        side = (b[0] - a[0]) * (polygon[:, 1] - a[1]) - (b[1] - a[1]) * (polygon[:, 0] - a[0])
        if np.all(side >= 0):
            continue
        kept = []
        for k in range(len(polygon)):
            n = (k + 1) % len(polygon)
            if side[k] >= 0:
                kept.append(polygon[k])
            if (side[k] >= 0) != (side[n] >= 0):
                kept.append(polygon[k] + side[k] / (side[k] - side[n]) * (polygon[n] - polygon[k]))
        polygon = np.array(kept)
    return polygon

def size(polygon):
    if len(polygon) < 3:
        return 0.0
    x, y = polygon[:, 0], polygon[:, 1]
    return 0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))

def anticlockwise(polygon):
    middle = polygon.mean(axis=0)
    return polygon[np.argsort(np.arctan2(polygon[:, 1] - middle[1], polygon[:, 0] - middle[0]))]

angles = np.arange(CORNERS) * 2 * math.pi / CORNERS
circle = cutoff * np.column_stack((np.cos(angles), np.sin(angles)))
area, floor = rectangle(area), rectangle(floor)

def density(people):
    """Returns the Voronoi density of the area, 1/m2."""
    inside = np.all((people >= floor.min(axis=0)) & (people <= floor.max(axis=0)), axis=1)
    people = people[inside]
    if len(people) == 0:
        return 0.0
    far = floor.mean(axis=0) + 1000 * np.array([(1, 0), (-1, 0), (0, 1), (0, -1.0)])  # close all cells of people
    cells = Voronoi(np.vstack((people, far)))
    total = 0.0
    for k, at in enumerate(people):
        if np.any(at < area.min(axis=0) - cutoff) or np.any(at > area.max(axis=0) + cutoff):
            continue
        corners = cells.vertices[cells.regions[cells.point_region[k]]]
        cell = clip(clip(anticlockwise(corners), at + circle), floor)
        total += size(clip(cell, area)) / size(cell)
    return total / size(area)

if recording.endswith(".sqlite"):
    database = sqlite3.connect(recording)
    fps = float(database.execute("SELECT value FROM metadata WHERE key = 'fps'").fetchone()[0])
    table = np.array(database.execute("SELECT frame, pos_x, pos_y FROM trajectory_data ORDER BY frame").fetchall())
else:
    with open(recording, encoding="utf-8") as file:
        fps = float(file.readline().split(":")[1].split()[0])
    table = np.loadtxt(recording)[:, [1, 2, 3]]
table = table[table[:, 0] <= float(until) * fps]
frames, starts = np.unique(table[:, 0], return_index=True)
# The probe's rows: means over the frames of each interval; a frame at its edge belongs to the interval before.
with open(os.path.join(folder, probe + ".csv"), newline="", encoding="utf-8") as text:
    rows = list(csv.DictReader(text))
middle, column = "time [s]", "density [1/m2]"  # the Voronoi density
every = 2 * float(rows[0][middle])
ours = {}
for frame, people in zip(frames, np.split(table[:, 1:], starts[1:])):
    number = max(math.ceil(frame / fps / every - 1e-6) - 1, 0)
    if number % 4 == 0:  # a quarter of the intervals, as cells take time
        ours.setdefault(number, []).append(density(people))
pairs = [(np.mean(ours[k]), float(row[column])) for k, row in enumerate(rows) if k in ours]
differences = [abs(a - b) for a, b in pairs]
near("greatest Voronoi density of %s, per m2" % probe, max(a for a, b in pairs), max(b for a, b in pairs), 0.02 * max(b for a, b in pairs))
near("mean Voronoi density of %s over %d intervals, per m2" % (probe, len(pairs)), np.mean([a for a, b in pairs]),
     np.mean([b for a, b in pairs]), 0.01 * np.mean([b for a, b in pairs]))
near("worst interval of %s, difference per m2" % probe, max(differences), 0, 0.05 * max(b for a, b in pairs))
if "--even" in sys.argv:  # the Gaussian's mean over the cells of the map in the area
    with open(os.path.join(folder, "danger-map.csv"), newline="", encoding="utf-8") as text:
        cells = [float(row["density_mean [1/m2]"]) for row in csv.DictReader(text)
                 if np.all(area.min(axis=0) <= (float(row["x [m]"]), float(row["y [m]"]))) and np.all((float(row["x [m]"]), float(row["y [m]"])) <= area.max(axis=0))]
    near("Gaussian and Voronoi density of an even crowd, per m2", np.mean([a for a, b in pairs]), np.mean(cells), 0.03 * np.mean(cells))
sys.exit(failures > 0)
