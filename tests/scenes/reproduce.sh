# jostle reproduce: claims in and out of band, errors of claims, runs that are made and reused.
. tests/scenes/lib.sh
says() { if grep -qF -- "$2" "$work/out"; then echo "ok $1"; else echo "not ok $1: nothing says '$2'"; head -8 "$work/out"; fi; }
mkdir -p "$work/claims"
cat >"$work/walk.yaml" <<'SCENE'
jostle: 1
duration: 20
places: {east: {point: [14, 0], radius: 1}}
groups: {walker: {behaviour: walker.lua, at: [[0, 0]], set: {goal: east, speed: 1.25}}}
probes:
  way:  {transit: [[[2, 3], [2, -3]], [[12, 3], [12, -3]]]}
  line: {flow: [[2, -3], [2, 3]]}
SCENE
cat >"$work/claims/good.lua" <<'CLAIM'
return claim {
  id = "G", title = "It walks", source = "nobody",
  runs = { walk = { scene = "../walk.yaml", seeds = 2 }, slow = { scene = "../walk.yaml", seeds = 1, duration = 30, set = { ["groups.walker.set.speed"] = 0.5 } } },
  quick = { slow = { set = { ["groups.walker.set.speed"] = 1 } }, walk = { seeds = 1, duration = 15 } },
  measure = function(run)
    local line = run.walk.csv("line")
    return {
      time = run.walk.summary.probes.way.mean, slow = run.slow.summary.probes.way.mean, rows = line.n,
      crossed = line.time[1], seed = run.walk.summary.seed, length = run.walk.summary.simulated_s,
    }
  end,
  expect = {
    { "time", unit = "s", source = 8, band = { 7.9, 8.1 } },
    { "slow", unit = "s", band = { 19.5, 20.5 } },
    { "rows", band = { 1, 1 } },
    { "crossed", unit = "s", band = { 1.6, 3.2 } },
    { "seed", reported = true }, { "length", unit = "s", reported = true },
  },
  plots = {
    { name = "speed", title = "Time over speed", x = "speed (m/s)", y = "time (s)",
      { "Jostle", figures = { { 0.5, "slow" }, { 1.25, "time" } } }, { "source", points = { { 1.25, 8 } } },
      { "law", line = { { 0.5, 20 }, { 1, 10 }, { 1.25, 8 } } } },
    { name = "map", title = "Time", x = "speed (m/s)", y = "way (m)", z = "time (s)",
      map = { { 0.5, 10, "slow" }, { 1.25, 10, "time" }, { 1.25, 20, "length" } } },
  },
  pictures = { walk = { "paths.png" } },
  tried = { "Walking <faster>: 3 m/s, no better", "Waiting" },
}
CLAIM
run=("$JOSTLE" reproduce --claims "$work/claims" --out "$work/rep" --quiet)

# ---- in band ----
expect "a claim in band is exit status 0" 0 "1 of 1 claims in band" "${run[@]}"
says "the output says so" "nobody): in band"
value() { grep -o "\"$1\": {\"mean\": [^,]*" "$work/rep/results.json" | sed 's/.* //'; }
between "the mean over two seeds, from 101 on" "$(value seed)" 101.5 101.5
says "with its 95 % bound (12.7 standard errors) and the number of seeds" "measured 101.5 +- 6.4 (101 to 102, 2 seeds)"
grep -q '101.5  | +- 6.4 | 2 |' "$work/rep/table.md" && grep -q '"bound": 6.35' "$work/rep/results.json"; verdict "table.md and results.json have the bound too" $?
between "settings of the claim hold" "$(value slow)" 19.5 20.5
"$JOSTLE" reproduce G --claims "$work/claims" --out "$work/set" --quiet --set groups.walker.set.speed=1.6 >"$work/set.out"
grep -q "slow .*measured 6\.25" "$work/set.out" && grep -q "with groups.walker.set.speed=1.6" "$work/set/index.html"
verdict "--set overrides them, and the page says so" $?
for file in index.html table.md results.json; do [ -s "$work/rep/$file" ]; verdict "it writes $file" $?; done
grep -q 'src="runs/walk-[^"]*/paths.png"' "$work/rep/index.html"; verdict "the page shows the picture" $?
[ "$(sed '/^Share of/,$d' "$work/rep/table.md" | grep -c '^| ')" = 7 ]; verdict "the table has a row for each figure" $?
grep -Eq "^\| [^|]*walk.yaml \| physical \| 3 \| 0 \| 0 \|" "$work/rep/table.md" && grep -Eq "<td>[^<]*walk.yaml<td>physical<td class=n>3<td class=n>0" "$work/rep/index.html"
verdict "the table and the page have a row for each scene and mode of forces" $?
[ "$(sqlite3 :memory: "select json_extract(readfile('$work/rep/results.json'), '\$.G.figures.rows.mean')")" = 1 ]; verdict "results.json is JSON" $?
[ -z "$(grep -o 'src="[^"]*"' "$work/rep/index.html" | sed 's/src="//; s/"//' | while read -r f; do [ -s "$work/rep/$f" ] || echo "$f"; done)" ]; verdict "all pictures of the page are there" $?

for plot in speed map; do
    [ -s "$work/rep/plots/good-$plot.png" ] && grep -q "src=\"plots/good-$plot.png\"" "$work/rep/index.html"; verdict "the page shows the plot $plot" $?
done
# x, mean, least, most and band of a figure; points of a source; a line of a law; cells of a map, one of them empty
awk '$1 == 1.25 && NF == 6 && $2 > 7.9 && $3 <= $2 && $4 >= $2 && $5 == 7.9 && $6 == 8.1 {f = 1} $1 == 1.25 && NF == 2 && $2 == 8 {s++} END {exit !(f && s == 2)}' "$work/rep/plots/good-speed.dat"; verdict "a plot has figures with their bands, points and lines" $?
[ "$(awk 'NF == 3 {print $1, $2, ($3 == "NaN" ? "none" : int($3 + 0.5))}' "$work/rep/plots/good-map.dat" | tr '\n' ';')" = "0 0 20;1 0 8;0 1 none;1 1 20;" ]; verdict "a map has a cell for each pair of values" $?
! grep -q "What was tried" "$work/rep/index.html" "$work/rep/table.md"; verdict "tried is not shown if nothing misses" $?
deviation() { grep -o "<td>$1<td class=n>$2<td><code>$3</code><td>[^<]*$4<td><a href=\"#c0\">G</a>" "$work/rep/index.html" | grep -q .; }
deviation speed "1.3&nbsp;m/s" 0.5 "walk.yaml, group walker" && deviation time_gap "0&nbsp;s" crowd.time_gap "behaviours/walker.lua" && ! deviation mass ".*" ".*" ".*"; verdict "the page lists exactly the settings of scenes and behaviours" $?

cp "$work/claims/good.lua" "$work/plotted"
sed -i '/^  plots = {/,/^  },/d; /^  pictures = /d' "$work/claims/good.lua" # the next thirty runs need not draw them

# ---- nulls ----
mkdir -p "$work/nulls"
write_null_claim() { # NAME, the null's settings
    cat >"$work/nulls/$1.lua" <<CLAIM
return claim {
  id = "$1", title = "It walks", source = "nobody", runs = { walk = { scene = "../walk.yaml", seeds = 2 } },
  null = { text = "another $1", set = { ["groups.walker.set.$1"] = $2 } },
  measure = function(run) return { time = run.walk.summary.probes.way.mean, rows = run.walk.csv("line").n } end,
  expect = { { "time", unit = "s", band = { 7.9, 8.1 } }, { "rows", band = { 1, 1 } } },
}
CLAIM
}
write_null_claim speed 1
write_null_claim mass 80
nulls=("$JOSTLE" reproduce --claims "$work/nulls" --out "$work/null" --quiet)
expect "a claim whose null misses a band is in band" 0 "nobody): in band" "${nulls[@]}" speed
says "the null's figure stands beside the claim's" "null 10, out"
says "and a figure that the null meets is marked" "null 1, in band too"
"${nulls[@]}" speed --set groups.walker.set.speed=1 --set groups.walker.set.speed=1.25 >"$work/out"
says "--set leaves a null what it is made of" "null 10, out"
expect "a claim whose null is in band proves nothing" 1 "NO EVIDENCE, its null misses no band" "${nulls[@]}"
says "and counts as missed" "1 of 2 claims in band; these miss: mass"
grep -q "Null, which must miss a band, 2 seeds: another speed" "$work/null/index.html" && grep -q "<td class=out>1, in band too" "$work/null/index.html"
verdict "the page shows both" $?
grep -q '"proves_nothing": true' "$work/null/results.json" && grep -Eq '"null": (10|9.99)' "$work/null/results.json"; verdict "results.json has them" $?
cat >"$work/nulls/speed.lua" <<'CLAIM'
return claim {
  id = "pair", title = "They walk", source = "nobody", pictures = { slow = { "paths.png" } },
  runs = {
    slow = { scene = "../walk.yaml", seeds = 1, set = { ["groups.walker.set.speed"] = 0.8, ["groups.walker.set.mass"] = 60 } },
    fast = { scene = "../walk.yaml", seeds = 1 },
    other = { scene = "../walk.yaml", seeds = 1, set = { ["groups.walker.set.speed"] = 0.8 } },
  },
  null = { text = "nobody is slow", runs = { slow = { set = { ["groups.walker.set.speed"] = 1.25 } }, other = { set = { ["groups.walker.set.mass"] = 60 } } } },
  measure = function(run) return { time = run.slow.summary.probes.way.mean, fast = run.fast.summary.probes.way.mean } end,
  expect = { { "time", unit = "s", band = { 12, 13 } }, { "fast", unit = "s", band = { 7.9, 8.1 } } },
}
CLAIM
"${nulls[@]}" pair --fresh --out "$work/pair" >"$work/out" 2>&1
says "a null may change one run alone" "null 8, out"
[ "$(ls "$work/pair/runs" | wc -l)" = 4 ]; verdict "and shares the others with the claim, in whatever order they are set" $?
[ "$(cat "$work"/pair/runs/*/run.txt | grep -c 'mass=60')" = 2 ]; verdict "and keeps what else the claim sets" $?
sed -i 's/null = { .*/no_null = "all of them <walk>",/' "$work/nulls/speed.lua"
expect "a claim may say why it has no null" 0 "no null: all of them <walk>" "${nulls[@]}" pair
grep -q "No null: all of them &lt;walk&gt;" "$work/null/index.html"; verdict "and the page says it" $?
sed -i 's/no_null = /null = { text = "slow" }, no_null = /' "$work/nulls/speed.lua"
expect "a null and a reason for none are an error" 3 'or no_null = "why there is none", not both' "${nulls[@]}" pair
sed -i 's/null = { text = "slow" }, //' "$work/nulls/speed.lua"
cp "$work/nulls/speed.lua" "$work/nulls/good"
sed -i 's/no_null = "[^"]*"/no_null = " "/' "$work/nulls/speed.lua"
expect "an empty reason for none is an error" 3 'nulls/speed.lua:1: a claim: no_null is empty' "${nulls[@]}" pair
sed -i 's/no_null = " "/null = { text = "", set = { ["groups.walker.set.mass"] = 60 } }/' "$work/nulls/speed.lua"
expect "a null that does not say what it takes out is an error" 3 'nulls/speed.lua:1: null: text is empty' "${nulls[@]}" pair
mv "$work/nulls/good" "$work/nulls/speed.lua"
sed 's/time = [^,]*,/time = run.walk.summary.seed - 100,/; s/null = .*//; s/band = { 7.9, 8.1 }/band = { 1 }/; s/"mass"/"mean"/' "$work/nulls/mass.lua" >"$work/nulls/mean.lua"
sed 's/unit = "s", band/sure = true, band/; s/"mean"/"sure"/' "$work/nulls/mean.lua" >"$work/nulls/sure.lua"
expect "a mean in band is enough" 0 "measured 1.5 +- 6.4" "${nulls[@]}" mean
expect "unless it must be sure" 1 "band 1 to inf: OUT, thin" "${nulls[@]}" sure
expect "which one seed cannot tell" 1 "band 1 to inf: OUT, thin" "${nulls[@]}" sure --seeds 102
grep -q "| at least 1, with the 95 % bound | misses, thin |" "$work/null/table.md"; verdict "and the table says that it must be" $?
sed -i '/expect/i null = { text = "one lighter", set = { ["groups.walker.set.mass"] = 60 } },' "$work/nulls/sure.lua"
"${nulls[@]}" sure >"$work/out"; says "a null is not out of a band for being unsure" "null 1.5, in band too"
cp "$work/nulls/mean.lua" "$work/nulls/twin.lua"
expect "two claims of one id are an error" 3 "mean.lua has the id mean, too" "${nulls[@]}" mean
rm "$work/nulls/mean.lua" "$work/nulls/sure.lua" "$work/nulls/twin.lua"
# ---- nulls that say nothing ----
sed 's/"mass"/"absent"/; s/time = /time = run.walk.summary.probes.way.mean < 9 and /' "$work/nulls/mass.lua" >"$work/nulls/absent.lua"
sed -i 's/set.mass"\] = 80/set.speed"] = 1/; s/rows = [^}]*}/rows = 1 }/; s/< 9 and/> 9 and 0\/0 or/' "$work/nulls/absent.lua"
expect "a null that lacks a figure is no evidence" 1 "NO EVIDENCE, its null misses no band" "${nulls[@]}" absent
says "and its figure is said not to be measured" "in; null -, not measured"
grep -q "| in band | not measured |" "$work/null/table.md"; verdict "also in the table" $?
sed 's/"absent"/"R99"/' "$work/nulls/absent.lua" >"$work/nulls/test.lua"
sed 's/"absent"/"R98"/; s/null = .*/no_null = "nothing is wrong",/' "$work/nulls/absent.lua" >"$work/nulls/bare.lua"
"${nulls[@]}" R98 R99 --standards >"$work/out" 2>&1
grep -q "It does not fail with the wrong input" "$work/null/standards.html" && grep -q "No wrong input: nothing is wrong" "$work/null/standards.html"
verdict "the page of standards says why a test shows nothing, and why one has no wrong input" $?
rm "$work/nulls/test.lua" "$work/nulls/bare.lua"
refuse_null() { # NAME, MESSAGE, NULL
    sed "s/null = .*/null = $3,/" "$work/nulls/mass.lua" >"$work/nulls/wrong.lua"
    expect "$1" 3 "$2" "${nulls[@]}" wrong
    rm "$work/nulls/wrong.lua"
}
refuse_null "a null with settings of all and of some runs is an error" "not both" '{ text = "x", set = {}, runs = { walk = {} } }'
refuse_null "a run of a null is a table" "run 'walk' is a table" '{ text = "x", runs = { walk = 1 } }'
refuse_null "a null has a seed" "a whole number from 1 on" '{ text = "x", seeds = 0, set = {} }'
refuse_null "a setting has a path" 'are given by name: ["PATH"] = VALUE' '{ text = "x", set = { "groups.walker.set.mass=60" } }'
rm "$work/nulls/absent.lua"
sed -i 's/set = {/sets = {/' "$work/nulls/mass.lua"
expect "a misspelt key of null is an error" 3 "null has no 'sets'; did you mean 'set'?" "${nulls[@]}"
sed -i 's/sets = {/set = {/; s/\["groups.walker.set.mass"\]/["groups.walker.set.masses"]/' "$work/nulls/mass.lua"
expect "a claim whose null cannot be measured proves nothing" 1 "NO EVIDENCE, its null could not be measured" "${nulls[@]}" mass
rm "$work/nulls/mass.lua"
write_null_claim speed 1
expect "--quick leaves one seed to runs without smaller ones" 0 "measured 8 (8 to 8, 1 seed)" "${nulls[@]}" speed --quick
says "and to their nulls" "null, 1 seed: another speed"
sed -i 's/null = /quick = { walk = { duration = 15 } }, null = /' "$work/nulls/speed.lua"
expect "and to runs that are only shorter" 0 "measured 8 (8 to 8, 1 seed)" "${nulls[@]}" speed --quick
expect "a claim of one seed is not cut" 0 "1 of 1 claims in band" "$JOSTLE" reproduce R1 --quick --quiet --out "$work/null"
! grep -q published "$work/out"; verdict "and is not said to be" $?

# ---- runs with different numbers of seeds ----
sed 's/slow = { scene = "..\/walk.yaml", seeds = 1/slow = { scene = "..\/walk.yaml", seeds = 1, dt = 0.02/; s/{ "seed", rep/{ "slow_seed", reported = true }, { "seed", rep/; s/seed = run.walk/slow_seed = run.slow.summary.seed, seed = run.walk/; /quick = {/d' "$work/claims/good.lua" >"$work/nulls/uneven.lua"
expect "a figure of two seeds says so" 0 "seed                     source -            measured 101.5 +- 6.4 (101 to 102, 2 seeds)" "${nulls[@]}" uneven
says "one that never changes tells what it may be" "slow_seed                source -            measured 101 (101 to 101, 1 to 2 seeds)"

# ---- what is done is not done again ----
stamps() { stat -c '%Y.%y %n' "$work"/rep/runs/*/summary.json | sort; }
runs() { "$JOSTLE" reproduce --claims "$work/claims" --out "$work/rep" "$@" 2>&1 >/dev/null | tail -1; }
"${run[@]}" >"$work/out"
stamps >"$work/before"
runs >"$work/out"; says "existing runs are reused" "3 of 3 runs done (3 from before"
stamps | cmp -s - "$work/before"; verdict "and left unchanged" $?
runs --fresh >"$work/out"; says "--fresh repeats them" "(0 from before"
sed -i 's/duration: 20/duration: 21/' "$work/walk.yaml"
runs >"$work/out"; says "runs of an edited scene are repeated" "(0 from before"
# A probe that is taken away leaves nothing behind to be measured.
sed -i '/^  line:/d' "$work/walk.yaml"
expect "a probe that was removed is a miss, not its former file" 1 "the run left no line.csv" "${run[@]}"
echo '  line: {flow: [[2, -3], [2, 3]]}' >>"$work/walk.yaml"

# ---- fewer and smaller ----
expect "--quick" 1 "these miss: G" "${run[@]}" --quick
between "--quick uses the settings of quick" "$(value length)" 15 15
between "and does not affect claims that share the runs" "$(value slow)" 9.9 10.1
says "and says which claims it cut" "are not the published ones; cut to fewer seeds or shorter runs: G"
grep -q "are not the published ones. Cut to fewer seeds or shorter runs: G\." "$work/rep/index.html" && grep -q "runs: G\." "$work/rep/table.md"; verdict "as do the page and the table" $?
expect "--seeds A-B" 0 "in band" "${run[@]}" --seeds 7-10
between "--seeds A-B replaces the claim's seeds" "$(value seed)" 8.5 8.5
expect "--seeds A" 0 "1 seed)" "${run[@]}" --seeds 12
between "--seeds A uses that seed alone" "$(value seed)" 12 12
expect "--seeds of an empty range is refused" 3 "is no seed, and no range" "${run[@]}" --seeds 9-3
sed 's/seeds = 2/seeds = "55-57"/; s/source = "nobody"/source = "nobody", level = "keen", held_out = "on <others>"/' "$work/claims/good.lua" >"$work/claims/named.lua"
sed -i 's/id = "G"/id = "R77"/' "$work/claims/named.lua"
expect "a claim names its seeds, and a group its claims" 0 "1 of 1 claims in band" "${run[@]}" rimea
between "the mean is over these seeds" "$(value seed)" 56 56
grep -q 'Haste: keen' "$work/rep/index.html" && grep -q 'Held out: on &lt;others&gt;' "$work/rep/index.html" && grep -q '| R77 It walks | keen | held out |' "$work/rep/table.md"; verdict "the page gives the level of haste and what was held out" $?
rm "$work/claims/named.lua"
expect "--list names claims and runs nothing" 0 "G  It walks (nobody)" "${run[@]}" --list --out "$work/nothing"
[ ! -e "$work/nothing" ]; verdict "--list writes nothing" $?

# ---- misses ----
sed 's/id = "G"/id = "BAD"/; s/7.9, 8.1/1, 2/; s/-- .*//' "$work/claims/good.lua" >"$work/claims/bad.lua"
expect "a claim out of band is exit status 1" 1 "1 of 2 claims in band; these miss: BAD" "${run[@]}"
says "its figure is marked OUT" "band 1 to 2: OUT"
says "figures in band are counted, in all and by claim" "7 of 8 figures in band (87.5 %): BAD 3 of 4, G 4 of 4"
grep -q "7 of 8 figures with a band are in it" "$work/rep/index.html" && grep -q "<td class=n>3 of 4<td class=out>misses" "$work/rep/index.html" && grep -qF "7 of 8 figures in band (87.5 %): BAD 3 of 4" "$work/rep/table.md"
verdict "on the page and in the table, too" $?
[ "$(sqlite3 :memory: "select json_extract(t, '\$.BAD.figures_in_band', '\$.all.figures_in_band', '\$.all.figures_with_band') from (select readfile('$work/rep/results.json') as t)")" = "[3,7,8]" ]
verdict "and in results.json" $?
grep -q 'class=out>misses' "$work/rep/index.html"; verdict "the page says so" $?
grep -qF '<li>Walking &lt;faster&gt;: 3 m/s, no better</li>' "$work/rep/index.html" && grep -qF -- '- Waiting' "$work/rep/table.md" && grep -qF 'BAD misses. What was tried:' "$work/rep/table.md" && ! grep -qF 'G misses' "$work/rep/table.md"; verdict "the page shows what was tried" $?
grep -qF "Walking &lt;faster>" "$work/rep/table.md" && ! grep -qF "<faster>" "$work/rep/table.md"; verdict "the table quotes it" $?
expect "one claim by its id" 0 "1 of 1 claims in band" "${run[@]}" G
expect "one claim by its file" 1 "0 of 1 claims in band; these miss: BAD" "${run[@]}" bad
expect "no such claim" 3 "there is no claim 'X'" "${run[@]}" X
sed 's/"BAD"/"long"/; s/^  quick = .*/  quick = false,/' "$work/claims/bad.lua" >"$work/claims/long.lua"
expect "--quick leaves a claim of a group out that has no quick runs" 1 "left out with --quick: long" "${run[@]}" real --quick
expect "unless it is named" 1 "these miss: long" "${run[@]}" long --quick
rm "$work/claims/long.lua"
rm "$work/claims/bad.lua"
# fails NAME TEXT [SED...]: the good claim with changes; a miss that says why
fails() {
    local name=$1 text=$2; shift 2
    sed "$@" "$work/claims/good.lua" >"$work/odd.lua"; mkdir -p "$work/odd"; mv "$work/odd.lua" "$work/odd/odd.lua"
    expect "$name" 1 "$text" "$JOSTLE" reproduce --claims "$work/odd" --out "$work/rep" --quiet
}
fails "a figure that is not measured" "measure returned no number 'rows'" -e 's/rows = line.n/rwos = line.n/'
fails "a figure that is not a number is out" "band 1 to 1: OUT" -e 's/rows = line.n/rows = 0 \/ 0/'
fails "a mistake in measure, with its line" "odd.lua:6:" -e 's/run.walk.csv("line")/run.wolk.csv("line")/'
fails "measure has nothing of what is expected" "odd.lua:5:" -e 's/  measure = function(run)/  measure = function(run) local e = run.expect.time/'
fails "a scene that is missing" "../absent.yaml" -e 's/slow = { scene = "..\/walk.yaml"/slow = { scene = "..\/absent.yaml"/'
printf 'jostle: 1\ngroups: {a: {behaviour: wlaker.lua, at: [[0, 0]]}}\n' >"$work/broken.yaml"
fails "a scene that is wrong, with its place" "broken.yaml:2:" -e 's/slow = { scene = "..\/walk.yaml"/slow = { scene = "..\/broken.yaml"/'
fails "a value that a scene does not have" "groups.walkr" -e 's/groups.walker.set.speed"\] = 0.5/groups.walkr.set.speed"] = 0.5/'
fails "measure that never ends" "odd.lua:" -e 's/  measure = function(run)/  measure = function(run) while true do end/'

# ---- claim files that are wrong: exit status 3, with file and line ----
cp "$work/plotted" "$work/claims/good.lua"
refuse() { # NAME TEXT SED...
    local name=$1 text=$2; shift 2
    sed "$@" "$work/claims/good.lua" >"$work/odd/odd.lua"
    expect "$name" 3 "$text" "$JOSTLE" reproduce --claims "$work/odd" --out "$work/rep" --quiet
    grep -q "odd.lua:[0-9]" "$work/out" || echo "not ok $name: no line"
}
refuse "a misspelt key" "did you mean 'source'?" -e 's/source = "nobody"/suorce = "nobody"/'
refuse "a misspelt key of a run" "did you mean 'seeds'?" -e 's/seeds = 2/seed = 2/'
refuse "a misspelt key of a figure" "did you mean 'band'?" -e 's/rows", band/rows", bnad/'
refuse "no id" 'needs id = "..."' -e 's/id = "G", //'
refuse "no measure" "needs measure = function(run)" -e '/measure = function/,/^  end,/d'
refuse "a band upside down" "'time' needs band" -e 's/7.9, 8.1/8.1, 7.9/'
refuse "a figure without a band" "'rows' needs band" -e 's/"rows", band = { 1, 1 }/"rows"/'
refuse "a figure twice" "'time' is expected twice" -e 's/"slow", unit/"time", unit/'
refuse "no seeds" "or 1 to 1000" -e 's/seeds = 2/seeds = 0/'
refuse "seeds that are no range" "seeds = \"101-110\"" -e 's/seeds = 2/seeds = "3-1"/'
refuse "an unknown level" "level is calm, normal or keen" -e 's/source = "nobody"/source = "nobody", level = "mad"/'
refuse "calibrated and held out" "not both" -e 's/source = "nobody"/source = "nobody", calibrated = "a", held_out = "b"/'
refuse "a duration that is a text" "duration is a number" -e 's/duration = 30/duration = "long"/'
refuse "a value that is a table" "is set to a table" -e 's/speed"\] = 0.5/speed"] = {}/'
refuse "quick of an unknown run" "quick: there is no run 'slwo'" -e 's/quick = { slow/quick = { slwo/'
refuse "pictures of an unknown run" "pictures: there is no run 'wlak'" -e 's/pictures = { walk/pictures = { wlak/'
refuse "a picture outside the run's folder" "names of files in its report" -e 's/"paths.png"/"..\/paths.png"/'
refuse "a plot of an unknown figure" "plot 'speed': there is no figure 'slwo'" -e 's/{ 0.5, "slow" }, { 1.25, "time" } } }/{ 0.5, "slwo" } } }/'
refuse "a plot's point without numbers" "plot 'speed': a point begins with numbers" -e 's/points = { { 1.25, 8 } }/points = { { 1.25, "eight" } }/'
refuse "a curve of two kinds" "one of figures, points and line" -e 's/{ "source", points/{ "source", line = { { 1, 2 } }, points/'
refuse "a curve of an unknown kind" "did you mean 'points'?" -e 's/{ "source", points/{ "source", pionts/'
refuse "a plot without a title" 'a plot needs title = "..."' -e 's/title = "Time over speed", //'
refuse "a plot outside the folder" "a name has letters" -e 's/name = "map"/name = "..\/map"/'
refuse "a map without its unit" 'a plot needs z = "..."' -e 's/, z = "time (s)"//'
refuse "two plots of one name" "there are two plots 'speed'" -e 's/name = "map"/name = "speed"/'
refuse "an empty plot" "needs a map, or from 1 to 12 curves" -e 's/^      map = .*/    },/'
refuse "tried that is no list of texts" "each of tried is a text" -e 's/, "Waiting" }/, 7 }/'
refuse "a syntax error" "odd.lua:7:" -e '7s/.*/    return { = 1 }/'
refuse "an unknown word" "clam" -e 's/return claim/return clam/'
printf 'return 5\n' >"$work/odd/odd.lua"
expect "a file without a claim" 3 "the file has no claim" "$JOSTLE" reproduce --claims "$work/odd" --out "$work/rep"
mkdir -p "$work/empty"
expect "a folder without claims" 3 "there are no claims in this folder" "$JOSTLE" reproduce --claims "$work/empty" --out "$work/rep"
expect "an unknown option" 2 "unknown option --qiuck" "$JOSTLE" reproduce --qiuck
expect "a help text" 0 "usage: jostle reproduce" "$JOSTLE" reproduce --help
: >"$work/file"
expect "an unwritable folder is an error" 1 "$work/file" "$JOSTLE" reproduce --claims "$work/claims" --out "$work/file/rep" --quiet

# ---- jostle check knows claims ----
expect "check accepts a claim" 0 "nothing wrong" "$JOSTLE" check "$work/claims"
sed 's/source = "nobody"/suorce = "nobody"/' "$work/claims/good.lua" >"$work/odd/odd.lua"
expect "check reports an error of a claim with its line" 3 "odd.lua:1:" "$JOSTLE" check "$work/odd"
sed 's/walk.yaml/absent.yaml/' "$work/claims/good.lua" >"$work/odd/odd.lua"
expect "check reports a missing scene of a claim" 3 "there is no scene" "$JOSTLE" check "$work/odd"

# ---- Ctrl-C ----
cat >"$work/long.yaml" <<'SCENE'
jostle: 1
duration: 100000
places: {yard: {polygon: [[0, 0], [40, 0], [40, 40], [0, 40]]}}
groups: {people: {behaviour: stander.lua, count: 2000, in: yard, spacing: 0.5}}
SCENE
sed -e 's/walk.yaml/long.yaml/' "$work/claims/good.lua" >"$work/odd/odd.lua"
"$JOSTLE" reproduce --claims "$work/odd" --out "$work/rep" --jobs 2 --quiet >"$work/out" 2>&1 </dev/null &
parent=$!
children() { ps -o pid= --ppid "$1" | wc -l; }
for _ in $(seq 50); do [ "$(children $parent)" = 2 ] && break; sleep 0.1; done
left=$(ps -o pid= --ppid $parent)
[ "$(echo $left | wc -w)" = 2 ]; verdict "--jobs 2 makes two runs at the same time" $?
kill -TERM $parent # bash lets what runs in the background ignore SIGINT
wait $parent
[ $? = 143 ]; verdict "an interruption is exit status 143, as of a run" $?
says "and the message says what is kept" "interrupted; what was done is kept in"
alive=0; for pid in $left; do kill -0 "$pid" 2>/dev/null && alive=1; done
verdict "no process is left after it" $alive
# Killed outright, it takes its runs along.
"$JOSTLE" reproduce --claims "$work/odd" --out "$work/rep" --jobs 2 --quiet >"$work/out" 2>&1 </dev/null &
parent=$!
for _ in $(seq 50); do [ "$(children $parent)" = 2 ] && break; sleep 0.1; done
left=$(ps -o pid= --ppid $parent)
kill -KILL $parent; wait $parent 2>/dev/null
for _ in $(seq 30); do alive=0; for pid in $left; do kill -0 "$pid" 2>/dev/null && alive=1; done; [ $alive = 0 ] && break; sleep 0.1; done
verdict "no process is left after SIGKILL" $alive

# ---- the shipped claims ----
"$JOSTLE" reproduce --list >"$work/out" 2>&1; verdict "the shipped claims can be read" $?
[ "$(grep -c '^[^ ]' "$work/out")" = "$(ls scenes/claims/*.lua | wc -l)" ]; verdict "each shipped claim is listed" $?
[ -z "$(cut -d' ' -f1 "$work/out" | sort | uniq -d)" ]; verdict "with an id of its own" $?
without=$(awk '/^[^ ]/ {id = $1; left[id]} /^   (null|no null): ./ {delete left[id]} END {for (id in left) print id}' "$work/out")
[ -z "$without" ]; verdict "each has a null, or says why it has none${without:+; these do not: }"$without $?
expect "short claims hold" 0 "4 of 4 claims in band" "$JOSTLE" reproduce R1 14 15 R7 --quick --out "$work/shipped" --quiet

# ---- claim 5 judges the game, not the machine: each of these machines breaks a rule ----
mkdir -p "$work/game/scenes/claims"
cp -r behaviours "$work/game/"
cp scenes/dodgeball* "$work/game/scenes/"
sed -e 's/seeds = 1, duration = 30 }/seeds = 1, duration = 3 }/' -e 's/seeds = 3 }/seeds = 1, duration = 3 }/' -e '/^  null = {/,/^  },/d' \
    scenes/claims/dodgeball.lua >"$work/game/scenes/claims/dodgeball.lua"
game() { "$JOSTLE" reproduce 5 --claims "$work/game/scenes/claims" --out "$work/game/out" --seeds 101 --quiet; }
foul() { # NAME FIGURE FROM TO: the behaviour with FROM made TO; the figure is then out of its band
    sed "s/$3/$4/" behaviours/dodgeball.lua >"$work/game/behaviours/dodgeball.lua"
    ! cmp -s behaviours/dodgeball.lua "$work/game/behaviours/dodgeball.lua" && game >"$work/out" 2>&1
    grep -qE "^ +$2 .*: OUT" "$work/out"; verdict "$1" $?
}
game >"$work/out" 2>&1; grep -qE "^ +broken .* band 0 to 0: in" "$work/out"; verdict "the shipped machine breaks no rule" $?
foul "attacking balls of the other court breaks the rules" broken 'grounded(ball) & inside(ball, own.court)' 'grounded(ball)'
foul "attacking balls in the air breaks the rules" broken 'grounded(ball) & inside(ball, own.court)' 'inside(ball, own.court)'
foul "dodging before the reaction time breaks the rules" broken 'lasts = own.reaction' 'lasts = 0.1'
foul "a hit that is no point is missed" missed 'hit_by(ball) & after(REBOUND)' 'hit_by(ball) \& after(9)'
exit 0
