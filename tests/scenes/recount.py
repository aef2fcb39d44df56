"""Counts figures of a report again from the recording of the same run, by the standard library and numpy alone: who left
when and where, who crossed each line and how fast, and the density at a spot by two kernels.
`recount.py RECORDING REPORT-FOLDER [--drop PERSON] [--radius METRES]`; with --drop as if that person had not been recorded,
with --radius by a Gaussian of another R than 1 m. The plan is that of scenes/evacuation.yaml."""
import csv, math, os, sqlite3, sys
import numpy as np

EXITS = {"south_exit": (17, 20, -3, -1), "east_exit": (27, 29, 9, 12)}  # m: x from, to; y from, to
LINES = {"south": ((19.2, 0), (17.8, 0)), "east": ((26, 11.2), (26, 9.8))}  # crossed from their right to their left
RECORDED_EACH = 0.05  # s
failures = 0

def tell(name, good, said):
    global failures
    failures += not good
    print(("ok " if good else "not ok ") + name + " (%s)" % said)

def near(name, ours, theirs, within):
    tell(name, abs(ours - theirs) <= within, "recounted %.4g, reported %.4g, within %.3g" % (ours, theirs, within))

def rows(folder, file):
    with open(os.path.join(folder, file), newline="", encoding="utf-8") as text:
        return list(csv.DictReader(text))

recording, folder = sys.argv[1:3]
dropped = int(sys.argv[sys.argv.index("--drop") + 1]) if "--drop" in sys.argv else -1
radius = float(sys.argv[sys.argv.index("--radius") + 1]) if "--radius" in sys.argv else 1.0  # m
database = sqlite3.connect(recording)
fps = float(database.execute("SELECT value FROM metadata WHERE key = 'fps'").fetchone()[0])
table = np.array(database.execute("SELECT frame, id, pos_x, pos_y FROM trajectory_data ORDER BY id, frame").fetchall())
table = table[table[:, 1] != dropped]
ids, starts = np.unique(table[:, 1], return_index=True)
ways = [way for way in np.split(table, starts[1:])]
end = table[:, 0].max()

# Who left when: the first frame without a person; where: the exit whose rectangle is nearest to the last position.
left = {name: [] for name in EXITS}
for way in ways:
    if way[-1, 0] < end or end < float(rows(folder, "danger.csv")[-1]["time [s]"]) * fps - 1:
        x, y = way[-1, 2:]
        name = min(EXITS, key=lambda e: math.hypot(max(EXITS[e][0] - x, 0, x - EXITS[e][1]), max(EXITS[e][2] - y, 0, y - EXITS[e][3])))
        left[name].append((way[-1, 0] + 1) / fps)
reported = {row["exit"]: row for row in rows(folder, "table-leaving.csv")}
near("people who left", sum(map(len, left.values())), float(reported["all"]["people"]), 0)
for name, times in left.items():
    near("people who left by " + name, len(times), float(reported[name]["people"]), 0)
    for share, column in ((0, "first [s]"), (1, "last [s]")):
        near("%s by %s" % (column[:-4], name), sorted(times)[0 if share == 0 else -1], float(reported[name][column]), 0.26)

# Crossings: a person's move between two frames meets the line; forward from its right to its left.
def side(a, b, p):
    return (b[0] - a[0]) * (p[:, 1] - a[1]) - (b[1] - a[1]) * (p[:, 0] - a[0])

counts = {row["line"]: row for row in rows(folder, "table-line-counts.csv")}
flows = {row["line"]: row for row in rows(folder, "table-lines.csv")}
for name, (a, b) in LINES.items():
    forward, back, times = 0, 0, []
    a, b = np.array(a, float), np.array(b, float)
    length = float(np.hypot(*(b - a)))
    for way in ways:
        p = way[:, 2:]
        s = side(a, b, p)
        for k in np.nonzero((s[:-1] < 0) != (s[1:] < 0))[0]:
            share = s[k] / (s[k] - s[k + 1])
            at = p[k] + share * (p[k + 1] - p[k])
            if 0 <= (at - a) @ (b - a) <= length * length:
                forward, back = (forward + 1, back) if s[k] < 0 else (forward, back + 1)
                times.append((way[k, 0] + share) / fps)
    near("crossings of %s forward" % name, forward, float(counts[name]["crossed forward"]), 0)
    near("crossings of %s back" % name, back, float(counts[name]["crossed back"]), 0)
    times = np.sort(times)
    samples = np.arange(10, end / fps, 0.5)
    most = max(np.searchsorted(times, samples, "right") - np.searchsorted(times, samples - 10, "right"))
    near("greatest flow over %s, per m and s" % name, most / 10 / length, float(flows[name]["greatest flow [1/(m s)]"]), 0.11)

# Densities. Gaussian of R = 1 m at the middle of the hall, where no wall is within 4 m: the sum over people of
# exp(-d^2 / R^2) / (pi R^2), mean and greatest of the samples at each half second.
spot = np.array((18.1, 6.1))
by_frame = {frame: table[table[:, 0] == frame][:, 2:] for frame in range(int(end) + 1)}
last = float(rows(folder, "danger.csv")[-1]["time [s]"])
values = []
for sample in rows(folder, "danger.csv"):
    people = by_frame.get(round(float(sample["time [s]"]) * fps), np.empty((0, 2)))
    values.append(np.sum(np.exp(-np.sum((people - spot) ** 2, axis=1) / radius**2)) / (math.pi * radius**2) if len(people) else 0.0)
cell = min(rows(folder, "danger-map.csv"), key=lambda row: math.hypot(float(row["x [m]"]) - spot[0], float(row["y [m]"]) - spot[1]))
near("greatest density at a spot, Gaussian, per m2", max(values), float(cell["density_max [1/m2]"]), 0.03 + 0.03 * max(values))
near("mean density at a spot, Gaussian, per m2", float(np.mean(values)), float(cell["density_mean [1/m2]"]), 0.01 + 0.03 * np.mean(values))
# Density by counting: people in the hall over its floor, greatest of the samples, beside the probe's classical density.
most = max(sum((11 <= p[:, 0]) & (p[:, 0] <= 25) & (1 <= p[:, 1]) & (p[:, 1] <= 13)) for p in by_frame.values())
near("most people in the hall", most, float({r["area"]: r for r in rows(folder, "table-areas.csv")}["hall"]["most people at a time"]), 1)
sys.exit(failures > 0)
