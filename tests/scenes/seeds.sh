# The report of several seeds: its sections, its sentences and tables compared with the runs, failed runs, and files that are
# continued.
. tests/scenes/lib.sh
page=$work/page
what=(scenes/evacuation.yaml --set groups.hall.count=30 --set groups.office.count=10 --set groups.archive.count=2 --dt 0.1 --set "report.author=B. Planner" --report "$page")
expect "a run of several seeds with a report" 0 "report: $page/index.html" "$JOSTLE" run "${what[@]}" --seeds 3 --for 45
grep -q "<th>Author<td>B. Planner" "$page/index.html" && grep -q "<th>Program<td>Jostle" "$page/index.html" && grep -q "counter(pages)" "$page/index.html"; verdict "the page has its title block and page numbers" $?
outlined "the page and its plots have their sections, titles and axes" "$page" seeds --no-ranges
for file in plan spread density density-greatest density-worst; do [ -s "$page/$file.png" ] && [ -s "$page/$file.svg" ]; verdict "  $file" $?; done
same_hash "the page has the hash of each run" "$(hash_of "$JOSTLE" scenes/evacuation.yaml --set groups.hall.count=30 --set groups.office.count=10 --set groups.archive.count=2 --dt 0.1 --for 45 --seed 2)" \
    "$(sed -n 's/^2,.*,\([0-9a-f]*\),$/\1/p' "$page/table-runs.csv")"
python3 - "$page" >"$work/check" 2>&1 <<'END'
import html, re, sqlite3, statistics, sys
page = sys.argv[1]
text = html.unescape(re.sub("<[^>]*>", "", open(page + "/index.html", encoding="utf-8").read())).replace("\xa0", " ")
db = sqlite3.connect(page + "/runs.sqlite")
def values(name):
    return dict(db.execute("select seed, value from figure where name = ?", (name,)))
def said(number):  # as the page writes it
    return "%.0f" % number if number == int(number) or number >= 1000 else "%.1f" % number if number >= 100 else "%.3g" % number
half, last, most = values("danger.leaving_s.p50"), values("danger.last_left_s"), values("density_max")
worst = max(last, key=lambda seed: last[seed])
assert "Half of those who left had done so by %s s" % said(statistics.median(half.values())) in text
assert re.search(r"the last by %s s \([^()]*; at most %s, seed %d\)" % (re.escape(said(statistics.median(last.values()))), re.escape(said(last[worst])), worst), text), text[:3000]
assert "The greatest density (Gaussian, R = 1 m) of any place and time was %s per m\u00b2" % said(statistics.median(most.values())) in text
cleared = len([v for v in values("danger.inside").values() if v == 0])
assert ("Yes, in all runs" if cleared == 3 else "in %d of 3 runs" % cleared) in text, cleared
inside = {}
for name, time, value in db.execute("select c.name, p.time, p.value from curve_point p join curve_name c on c.id = p.curve where c.name = 'people inside'"):
    inside.setdefault(round(time, 6), []).append(value)
block = open(page + "/spread.dat").read().split("# people inside")[1].split("\n\n")[0].splitlines()[1:]
assert len(block) == len(inside)
for line in block:
    time, least, low, median, high, greatest = map(float, line.split())
    now = inside[time]
    assert (least, median, greatest) == (min(now), statistics.median(now), max(now)) and least <= low <= median <= high <= greatest, line
END
[ ! -s "$work/check" ]; verdict "medians, worst cases and bands are those of the runs" $?
head -5 "$work/check"
expect "one more seed: finished runs are kept" 0 "4 of 4 runs done (3 from before)" "$JOSTLE" run "${what[@]}" --seeds 4 --for 45
expect "fewer seeds: a page of these alone" 0 "2 of 2 runs done (2 from before)" "$JOSTLE" run "${what[@]}" --seeds 2 --for 45
grep -q "Evacuation: 2 runs with different seeds" "$page/index.html" && [ "$(grep -c '^<tr><td class=n>3<td' "$page/index.html")" = 0 ]; verdict "  without the others" $?
expect "with other inputs all runs are repeated" 0 "2 of 2 runs done, 0 running" "$JOSTLE" run "${what[@]}" --seeds 2 --for 5
grep -q "In no run did anybody leave within 5 s" "$page/index.html"; verdict "  the page says that nobody left" $?
cp "$page/runs.sqlite" "$work/runs.sqlite"
expect "report of a sweep's file makes the same page" 0 "report: $work/again/index.html" "$JOSTLE" report "$work/runs.sqlite" --out "$work/again"
cmp -s "$work/again/index.html" "$page/index.html"; verdict "  byte for byte" $?
expect "  with a title block of its own" 0 "report:" "$JOSTLE" report "$work/runs.sqlite" --author "A. Engineer" --title "Hall & exits" --out "$work/signed"
grep -q "<h1>Hall &amp; exits: 2 runs with different seeds</h1>" "$work/signed/index.html" && grep -q "<th>Author<td>A. Engineer" "$work/signed/index.html"; verdict "  which the page states" $?
! grep -q "$work\|/tmp" "$work/signed/index.html"; verdict "  without a path of this machine" $?
expect "  and refuses --summary" 2 "the runs of a sweep go with --out DIR alone" "$JOSTLE" report "$work/runs.sqlite" --summary -
printf 'return machine { name = "odd", start = "A", states = { A = { steer = drift(1, 0) } } }\n' >"$work/odd.lua"
printf 'jostle: 1\ngroups: {walkers: {behaviour: odd.lua, at: [[9999.5, 0], [9, 9]]}}\n' >"$work/fails.yaml"
expect "if all runs fail the page gives the reasons" 1 "report:" "$JOSTLE" run "$work/fails.yaml" --set guard.people=end --seeds 2 --for 2 --report "$work/failed"
[ "$(grep -c '<td>step 8, t = 0.40 s: the position of agent 0 is more than 10 km' "$work/failed/index.html")" = 2 ]; verdict "  for each run" $?
expect "an unwritable folder is an error" 1 "cannot make the folder '/proc/x'" "$JOSTLE" run "${what[@]}" --seeds 2 --report /proc/x
