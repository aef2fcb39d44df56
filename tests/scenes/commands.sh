# The commands as a user calls them: exit statuses, errors, reload, seeds, limits of scripts.
. tests/scenes/lib.sh
expect "help" 0 "usage: jostle" "$JOSTLE" --help
expect "run --help" 0 "--threads" "$JOSTLE" run --help
expect "version" 0 "jostle 0." "$JOSTLE" --version
expect "unknown command" 2 "unknown command 'fly'" "$JOSTLE" fly
expect "unknown option" 2 "Did you mean --seed" "$JOSTLE" run scenes/circle.yaml --sed 3
expect "no scene" 2 "no scene given" "$JOSTLE" run
expect "bad number" 2 "takes a number" "$JOSTLE" run scenes/circle.yaml --dt fast
expect "zero step" 2 "0.001" "$JOSTLE" run scenes/circle.yaml --dt 0
expect "missing scene" 3 "no-such.yaml" "$JOSTLE" run no-such.yaml
for name in $("$JOSTLE" --help | sed -n 's/^  jostle run \([^ ]*\) .*/\1/p'); do
    expect "a scene by its name from anywhere: $name" 0 "\"steps\": 1," env -C "$work" "$PWD/$JOSTLE" run "$name" --steps 1 --quiet --summary -
done
expect "an unknown scene name is refused with the nearest one" 3 "Did you mean 'office'" env -C "$work" "$PWD/$JOSTLE" run offfice
expect "render finds a scene by its name" 0 "circle.svg" env -C "$work" "$PWD/$JOSTLE" render circle --out circle.svg
expect "a misspelt command is refused with the nearest one" 2 "jostle: unknown command 'runn'. Did you mean 'run'?" "$JOSTLE" runn
expect "a scene in place of a command is told to be run" 2 "jostle run office" "$JOSTLE" office
for command in "run ofice" "render ofice" "sweep ofice --set duration=1 --out $work/no.sqlite" "compare ofice --out $work/no" "bench ofice" "check ofice" \
    "mod list ofice" "mod why a.b ofice" "reference mods ofice" "run scenes/ofice.yaml" "check scenes/ofice.yaml"; do
    expect "a misspelt scene gives one message: $command" 3 "office" "$JOSTLE" $command
    [ "$(grep -c . "$work/out")" = 1 ] || grep -q '^Try' "$work/out" && grep -q "Did you mean '\(scenes/\)*office\(.yaml\)*'?" "$work/out"; verdict "  with the nearest name" $?
done
for command in "check circle" "mod list circle" "mod why step circle" "bench circle --steps 1 --warm-up 0" "reference mods circle"; do
    expect "a scene by its name: $command" 0 "" env -C "$work" "$PWD/$JOSTLE" $command
done
expect "bench refuses a misspelt name" 3 "Did you mean 'running-through'?" "$JOSTLE" bench runing-through
expect "mod refuses a misspelt verb" 2 "there is no verb 'lst'. Did you mean 'list'?" "$JOSTLE" mod lst
expect "  and says how many arguments a verb takes" 2 "why takes PATH SCENE, not 1 argument" "$JOSTLE" mod why a.b
expect "  and refuses a misspelt mod" 3 "there is no mod 'ruogh' here. Did you mean 'rough'?" "$JOSTLE" mod enable ruogh
expect "reproduce refuses a misspelt claim" 3 "Did you mean 'paper'?" "$JOSTLE" reproduce papr --list
expect "reference refuses a misspelt page" 2 "Did you mean 'behaviours'?" "$JOSTLE" reference behavior
expect "new refuses an unknown kind" 2 "there are behaviour, scene, mod" "$JOSTLE" new thing x
expect "test refuses a misspelt path" 3 "Did you mean 'behaviours/tawaf.lua'?" "$JOSTLE" test behaviours/tawf.lua
expect "a range in place of a number is refused" 3 "this must be one number, not '60..90'. Several, one run each, are for \`jostle sweep\`, with commas: PATH=60,70,80,90" \
    "$JOSTLE" run circle --set groups.crossing.count=60..90
expect "  also in a sweep" 3 "with commas: PATH=60,70,80,90" "$JOSTLE" sweep circle --set groups.crossing.count=60-90 --out "$work/no.sqlite"
# A run lists only files that it wrote, and refuses file names with the ending of another kind.
expect "a recording that cannot be started is an error" 1 "cannot record" "$JOSTLE" run circle --for 1 --record /nonexist/x
! grep -q "Files" "$work/out"; verdict "  and is not listed as a file of the run" $?
expect "a run lists the files that it wrote" 0 "" "$JOSTLE" run circle --for 1 --record "$work/files.sqlite" --summary "$work/files.json"
grep -qF "Files: recording $work/files.sqlite, figures $work/files.json." <(tr '\n' ' ' <"$work/out"); verdict "  all of them" $?
for wrong in "--report x.html" "--data x.csv" "--checkpoint 1 --checkpoint-dir x.sqlite" "--summary x.csv" "--record x.csv" "--log-input x.json"; do
    expect "a file name with the ending of another kind is refused: $wrong" 2 "looks like" "$JOSTLE" run circle --for 1 $wrong
done
expect "bad override" 3 "Did you mean 'crossing'" "$JOSTLE" run scenes/circle.yaml --set groups.crosing.count=3
expect "negative mass" 3 "mass must be" "$JOSTLE" run scenes/running-through.yaml --set groups.runner.set.mass=-5
expect "0 agents" 3 "0 agents" "$JOSTLE" run scenes/circle.yaml --set groups.crossing.count=0
expect "unwritable recording" 1 "cannot record" "$JOSTLE" run scenes/running-through.yaml --quiet --record /proc/x/y
expect "unwritable report" 1 "cannot make" "$JOSTLE" run scenes/running-through.yaml --quiet --report /proc/x/y
expect "check finds nothing wrong with the shipped files" 0 "nothing wrong" "$JOSTLE" check scenes behaviours
mkdir -p "$work/parts/deep"
cat >"$work/parts/user.lua" <<'END'
local busy, calm = require("busy"), require "deep/calm"
return machine { name = "user", start = "A", states = { A = { steer = hold, { to = "B", when = busy.near("post") & calm } },
  B = { steer = hold } } }
END
echo 'return { near = function(place) return near(place, 2) end }' >"$work/parts/busy.lua"
echo 'return ~stuck(2)' >"$work/parts/deep/calm.lua"
expect "check takes a file that returns values for a library" 0 "busy.lua: note: no machine, but a library of 1 value" "$JOSTLE" check "$work/parts"
expect "  also if another file requires it" 0 "deep/calm.lua: note: no machine, but a library" "$JOSTLE" check "$work/parts"
mkdir -p "$work/circle"
echo 'local b = require "b" return machine { name = "a", start = "A", states = { A = { steer = hold } } }' >"$work/circle/a.lua"
echo 'local a = require "a" return { n = 1 }' >"$work/circle/b.lua"
expect "files that require each other in a circle are refused" 3 "a.lua:1:19: cannot require 'b': it is being loaded, and leads back to itself" "$JOSTLE" check "$work/circle/a.lua"
echo 'return { near = function(place) return near(place, 2) and lasted end }' >"$work/parts/busy.lua"
expect "  errors in a library are reported" 3 "busy.lua:1:55: 'and' decides" "$JOSTLE" check "$work/parts"
echo 'local m = machine { name = "m", start = "A", states = { A = { steer = hold } } }' >"$work/parts/busy.lua"
expect "  and a file that makes a machine but does not return it" 3 "must return one machine, not nil" "$JOSTLE" check "$work/parts"
echo 'return { name = "m", start = "A", states = { A = { steer = hold } } }' >"$work/parts/busy.lua"
expect "  or returns a plain table" 3 "A plain table is no machine" "$JOSTLE" check "$work/parts"
rm -r "$work/parts"
expect "check counts notes" 0 "nothing wrong, " "$JOSTLE" check scenes/opening-300.yaml
expect "--trace prints transitions" 0 "Run -> Arrived" "$JOSTLE" run scenes/running-through.yaml --quiet --trace 25
expect "  with the words of the condition and their values" 0 "when after(own.alarm 5) is true" "$JOSTLE" run scenes/evacuation.yaml --quiet --trace 9 --for 6
expect "  with the condition as written in the file" 0 " > 3 or after(12) is " "$JOSTLE" run scenes/station.yaml --quiet --trace 3 --for 30
cat >"$work/till.yaml" <<'END'
jostle: 1
duration: 1
groups:
  buyers: {behaviour: buyer.lua, at: [[0, 0], [1, 0]]}
  seller: {behaviour: seller.lua, at: [[0.5, 1]]}
END
echo 'memory { earned = 0, told = false } return machine { name = "seller", start = "A", states = { A = { steer = hold } } }' >"$work/seller.lua"
pays() { # WHAT: code for the function of both buyers
    cat >"$work/buyer.lua" <<END
return machine { name = "buyer", start = "A", states = { B = { steer = hold }, A = { steer = hold, { to = "B", on_take = function(me)
  for _, other in ipairs(me.neighbours) do
    if other.machine == "seller" then $1 end
  end end } } } }
END
}
calls() { # HEARD CALL: checks a behaviour that hears a signal and one that gives it by CALL
    cat >"$work/seller.lua" <<END
return machine { name = "seller", start = "A", states = { A = { steer = hold, on_exit = function(me) $2 end,
  { to = "A", when = heard "$1" } } } }
END
    "$JOSTLE" check "$work/till.yaml"
}
pays "other.earned = 0"
calls redy 'me.signal("ready")' | grep -q "no machine of the scene gives the signal 'redy'"; verdict "check warns of a signal that no function gives" $?
calls ready 'me.signal("ready")' | grep -q "gives the signal"; [ $? = 1 ]; verdict "  not of one that a function gives" $?
calls redy 'me.signal(me.x > 0 and "redy" or "ready")' | grep -q "gives the signal"; [ $? = 1 ]; verdict "  nor if the name is computed" $?
echo 'memory { earned = 0, told = false } return machine { name = "seller", start = "A", states = { A = { steer = hold } } }' >"$work/seller.lua"
pays "other.earned = other.earned + 5"
expect "lost changes of another agent's memory are reported" 0 "buyer.lua:3: 'earned' of agent 2 is changed by several in step 0" "$JOSTLE" run "$work/till.yaml"
pays "other.told = not other.told or true"
"$JOSTLE" run "$work/till.yaml" 2>&1 | grep -q "is changed by several"; [ $? = 1 ]; verdict "  not if all set the same value" $?
cat >"$work/caller.lua" <<'END'
local mine = memory { last = list(4), kept = 0 }
return machine { name = "caller", start = "A", states = {
  A = { steer = hold, { every = 0.05, set = { last = mine.last:push(now.time) } }, { to = "B", when = after(0.1), tell = { neighbours "anyone", "late" } } },
  B = { steer = hold, { when = told "late" & after(9) }, { to = "C", when = after(0.5) } },
  C = { become = "quiet" } } }
END
echo 'memory { last = list(2), kept = false } return machine { name = "quiet", start = "A", states = { A = { steer = hold } } }' >"$work/quiet.lua"
printf 'jostle: 1\nduration: 1\ngroups: {g: {behaviour: caller.lua, at: [[0, 0], [1, 0]]}}\n' >"$work/late.yaml"
expect "messages that wait when an agent becomes a machine that never asks for them are counted" 0 '"messages_unasked": 2' "$JOSTLE" run "$work/late.yaml" --quiet --summary -
expect "a list that is longer than in the machine which agents become is told" 0 "caller.lua:5:9: warning: the list 'last' holds 4 items, and 2 in 'quiet': of more, the oldest are dropped there" "$JOSTLE" check "$work/late.yaml"
expect "  and memory of another kind" 0 "memory 'kept' is of another kind in 'quiet', and begins anew there" "$JOSTLE" check "$work/late.yaml"
expect "--profile-lua lists the cost of functions" 0 "state Touch > on_exit" "$JOSTLE" run scenes/tawaf.yaml --steps 2 --quiet --profile-lua --set groups.pilgrims.count=50 --set sources.0.keep=50
expect "reference prints behaviours by default" 0 "### Conditions" "$JOSTLE" reference behaviours
expect "reference refuses an unknown page" 2 "there is no page 'plants'; there are behaviours, scenes" "$JOSTLE" reference plants
cat >"$work/flow.yaml" <<'END'
jostle: 1
duration: 3
places: {goal: {point: [8, 0], radius: 1}}
probes: {line: {flow: [[4, -1], [4, 1]]}}
groups: {people: {behaviour: presser.lua, at: [[0, 0]], set: {goal: goal}}}
END
expect "check notes that flows by ORCA are not fit for capacities" 0 "ORCA, which is not fit for capacities. Where capacities matter: walker.lua, or time_gap = crowd.time_gap" "$JOSTLE" check "$work/flow.yaml"
"$JOSTLE" run "$work/flow.yaml" --quiet --no-half-step --report "$work/flow" >/dev/null 2>&1
grep -q 'ORCA.*time_gap = crowd.time_gap' "$work/flow/index.html"; verdict "the report says so too" $?
sed 's/presser/walker/' "$work/flow.yaml" >"$work/law.yaml"
"$JOSTLE" run "$work/law.yaml" --quiet --no-half-step --report "$work/law" >/dev/null 2>&1
! grep -q "not fit for capacities" "$work/law/index.html" && ! "$JOSTLE" check "$work/law.yaml" | grep -q ORCA; verdict "no such note for people who walk by the walking law" $?
sed '/^probes/d' "$work/flow.yaml" >"$work/noflow.yaml"
! "$JOSTLE" check "$work/noflow.yaml" | grep -q ORCA; verdict "no such note if no flow is measured" $?
expect "check --json" 3 '"code": "unreadable-file"' "$JOSTLE" check no-such.lua --json
expect "view: no recording" 2 "no recording given" "$JOSTLE" view
expect "view: missing recording" 3 "cannot be read" "$JOSTLE" view no-such.sqlite
printf 'SQLite format 3\0%512s' x >"$work/no.sqlite"
expect "view: a file that is no recording" 3 "is not a database" "$JOSTLE" view "$work/no.sqlite"
expect "view: a scene is no recording" 3 "scenes/circle.yaml" "$JOSTLE" view scenes/circle.yaml
"$JOSTLE" run circle --for 1 --quiet --record "$work/circle.sqlite"
expect "view: missing scene" 3 "no-such.yaml" "$JOSTLE" view "$work/circle.sqlite" --scene no-such.yaml
expect "view: bad option" 2 "Did you mean --scene" "$JOSTLE" view x.sqlite --scen y
expect "bench prints times" 0 "running-through" "$JOSTLE" bench scenes/running-through.yaml --steps 10 --warm-up 5
"$JOSTLE" bench scale-1k --isa scalar,sse2 --rounds 3 --steps 3 --warm-up 1 --json >"$work/bench.json" 2>/dev/null
[ "$(grep -c '"agents": 1000,' "$work/bench.json")" = 2 ] && [ "$(grep -c '"rounds": 3,' "$work/bench.json")" = 2 ]; verdict "bench times a named scene with two instruction sets and three rounds" $?
python3 -c 'import json, sys
for case in json.load(open(sys.argv[1])): assert 300 < case["resident_bytes_per_agent"] < 4000, case' "$work/bench.json"; verdict "  and tells the resident memory of an agent" $?
# Enough steps for the clock of processor time, which may advance by 10 ms.
# The machine of the Tawaf on a smaller floor: with more memory an agent than this, a million people take more, too.
python3 - "$work/tawaf-small.yaml" "$PWD/behaviours" <<'END'
import re, sys
text = open("tests/bench/tawaf-million.yaml").read().replace("1000000", "40000").replace("../../behaviours", sys.argv[2])
narrow = lambda part: re.sub(r"-?\d+(\.\d+)?", lambda number: "%.4g" % (0.2 * float(number[0])), part)
text = re.sub(r"(?m)(^  (?:mataf|arrivals):|\{point:|^heatmap:)(.*)", lambda line: line[1] + narrow(line[2]), text)
open(sys.argv[1], "w").write(text)
END
"$JOSTLE" bench "$work/tawaf-small.yaml" --trusted --steps 5 --warm-up 10 --json >"$work/bench.json" 2>/dev/null
python3 -c 'import json, sys
(case,) = json.load(open(sys.argv[1]))
assert case["agents"] == 40000 and 400 < case["resident_bytes_per_agent"] < 870, case' "$work/bench.json"; verdict "a pilgrim takes less than 870 bytes" $?
"$JOSTLE" bench scale-1k scenes/circle.yaml --steps 1000 --warm-up 0 --csv "$work/bench.csv" --commit 'a "b", c' --plot "$work/plot" >/dev/null 2>&1
"$JOSTLE" bench scale-1k --steps 2 --warm-up 0 --csv "$work/bench.csv" >/dev/null 2>&1
[ "$(grep -c '^cpu,commit,' "$work/bench.csv")" = 1 ] && [ "$(wc -l <"$work/bench.csv")" = 4 ] &&
    [ "$(grep -c ',"a ""b"", c",.*,scenes/circle.yaml,1000,' "$work/bench.csv")" = 1 ]; verdict "bench appends lines to a CSV file" $?
grep -q '</svg>' "$work/plot/bench.svg" && grep -q 'scenes/circle.yaml' "$work/plot/bench.svg"; verdict "bench draws a picture" $?
"$JOSTLE" bench worlds-of-2 scenes/catch.yaml --steps 3 --warm-up 0 --json >"$work/bench.json" 2>/dev/null
[ "$(grep -c '"processors_of_others": [0-9.]*, "bullet_ns": ' "$work/bench.json")" = 1 ] && [ "$(grep -c '"bullet_ns": [1-9]' "$work/bench.json")" = 2 ] && [ "$(grep -c '"bodies_in_bullets": [1-9]' "$work/bench.json")" = 2 ]; verdict "bench times many small worlds, and Bullet's own share" $?
expect "bench: a table that cannot be written" 1 "cannot write" "$JOSTLE" bench scale-1k --steps 1 --warm-up 0 --csv "$work"
expect "bench compares numbers of threads" 0 "* more threads than processors" "$JOSTLE" bench scale-1k --threads 1,2,64 --steps 40 --warm-up 1 --rounds 3 --csv "$work/threads.csv"
grep -qE '^solve +64\* ' "$work/out" && grep -qE '^1000 agents|: 1000 agents, ' "$work/out"; verdict "  in a table" $?
python3 - "$work/threads.csv" "$(nproc)" <<'END'; verdict "  and a CSV file, whose speed-ups, efficiencies and sums are those of its times" $?
import csv, sys
rows = list(csv.DictReader(open(sys.argv[1])))
assert len(rows) == 42 and [r["stage"] for r in rows[:3]] == ["all", "perceive", "think"], rows
assert [r["stage"] for r in rows[10:14]] == ["enter", "leave", "collect", "rest"], rows
first = {r["stage"]: r for r in rows[:14]}
near = lambda a, b: abs(a - b) <= 1e-4 * max(abs(a), abs(b), 1e-3)
for r in rows:
    wall, was, n = float(r["wall_ns"]), float(first[r["stage"]]["wall_ns"]), int(r["threads"])
    assert float(r["least_wall_ns"]) <= wall and r["rounds"] == "3"
    assert r["is_measure"] == "no" or (r["is_measure"] == "yes" and n <= int(sys.argv[2])), r
    assert (r["cpu_ns"] == "") == (r["stage"] != "all")
    if wall > 0:
        assert near(float(r["speed_up"]), was / wall) and near(float(r["efficiency"]), was / wall / n), r
        assert near(float(r["lost_ns"]) + was / n, wall), r
for n in "1", "2", "64":
    least = [float(r["least_wall_ns"]) for r in rows if r["threads"] == n]
    assert sum(least[1:]) <= least[0] * 1.001 and least[-1] <= 0.05 * least[0], least
END
grep -q '^Of the machine.s [0-9]* processors\?, other programs kept busy: ' "$work/out"; verdict "  and what other programs did meanwhile" $?
expect "  a CSV file of other columns is refused" 1 "it has lines of other columns" "$JOSTLE" bench scale-1k --threads 1,2 --steps 1 --warm-up 0 --rounds 1 --csv "$work/bench.csv"
expect "  and numbers that are none, or repeated" 2 "has the number 2 twice" "$JOSTLE" bench scale-1k --threads 1,2,2
expect "  and worlds that one thread steps in turn" 3 "by one thread" "$JOSTLE" bench worlds-of-2 --threads 1,2
expect "bench refuses an unknown instruction set" 2 "scalar" "$JOSTLE" bench circle --isa scalar,none
"$JOSTLE" run scenes/running-through.yaml --quiet --seeds 3 --for 2 --summary "$work/seeds.json"
(root=$PWD; cd "$work" && "$(case $JOSTLE in /*) echo "$JOSTLE" ;; *) echo "$root/$JOSTLE" ;; esac)" run "$root/scenes/running-through.yaml" --quiet --for 2 --report some/where >/dev/null 2>&1)
"$JOSTLE" run scenes/running-through.yaml --quiet --no-half-step --for 2 --report "$work/made/report" --summary "$work/made/summary.json" >/dev/null 2>&1 && [ -s "$work/made/summary.json" ]; verdict "a summary beside a report is written into a new folder" $?
[ -s "$work/some/where/density.png" ]; verdict "a report is written into a new folder given by a relative path" $?
grep -q '"runs": 3' "$work/seeds.json" && grep -q '"lp_failure_share": {"mean"' "$work/seeds.json"; verdict "--seeds makes several runs and aggregates them" $?
grep -q '^  "seed": \[1, 2, 3\],*$' "$work/seeds.json" && grep -q '^  "dt": 0.0[0-9]*,*$' "$work/seeds.json" && ! grep -q '"\(seed\|dt\|threads\)": {"mean"' "$work/seeds.json"; verdict "values that are no figures are listed, not averaged" $?
"$JOSTLE" run scenes/evacuation.yaml --quiet --seeds 2 --seed 7 --for 3 --data "$work/each" --summary /dev/null 2>/dev/null
[ -s "$work/each/seed-7/danger.csv" ] && [ -s "$work/each/seed-8/danger.csv" ] && ! cmp -s "$work/each/seed-7/danger.csv" "$work/each/seed-8/danger.csv" && [ ! -e "$work/each/danger.csv" ]; verdict "each seed has its own CSV files" $?
"$JOSTLE" run scenes/running-through.yaml --quiet --steps 5 --summary - | grep -q "$(sha256sum scenes/running-through.yaml | cut -d' ' -f1)"
verdict "the summary lists its inputs" $?
# Rules that no equation of the paper prints: both act in the default mode, and neither in literal.
rules() { # ARGS...: prints the shares of agent-steps without a velocity, turned aside, and bounded
    "$JOSTLE" run scenes/two-bottlenecks.yaml --quiet --for 24 --summary - "$@" | sed -n 's/^ "\(lp_failure\|turned_aside\|plans_bounded\)_share": \(.*\),$/\2/p' | tr '\n' ' '
}
rules --threads 1 >"$work/rules" && [ "$(rules --threads 2 --isa scalar)" = "$(cat "$work/rules")" ] && awk '{exit !(NF == 3 && $1 > 0 && $2 > 0 && $3 > 0)}' "$work/rules"; verdict "the summary counts both unprinted rules, alike over threads and instruction sets" $?
rules --set forces.mode=literal | awk '{exit !(NF == 3 && $1 > 0 && $2 == 0 && $3 == 0)}'; verdict "  and neither acts in literal" $?
cat >"$work/literal.yaml" <<'END'
jostle: 1
forces: {mode: literal}
groups: {all: {behaviour: literal.lua, at: [[0, 0]], set: {brace: 100 N, mass: 80}}}
END
printf 'return machine { name = "literal", start = "A", defaults = { speed = 1 },\n  states = { A = { steer = hold, yield = 0 } } }\n' >"$work/literal.lua"
expect "check notes a parameter without effect in literal mode" 0 "literal.yaml:3:60: note: 'brace' has no effect in literal mode" "$JOSTLE" check "$work/literal.yaml"
grep -q "literal.lua:2: note: 'yield' has" "$work/out" && [ "$(grep -c "has no effect" "$work/out")" = 2 ]; verdict "  each once, and none that has an effect" $?
expect "  a run does too" 0 "'brace' has no effect in literal mode" "$JOSTLE" run "$work/literal.yaml" --for 1 --no-half-step --report "$work/literal"
grep -q "'brace' has no effect in literal mode\|&#39;brace&#39; has no effect" "$work/literal/index.html"; verdict "  and its report" $?
expect "  and none is given in the default mode" 0 "" "$JOSTLE" run "$work/literal.yaml" --for 1 --set forces.mode=physical
! grep -q "has no effect" "$work/out"; verdict "    of none" $?
expect "  and the last lines tell them" 0 "aside, and the plans of" "$JOSTLE" run scenes/two-bottlenecks.yaml --for 5

# Hostile behaviours: none hangs or ends a run, and each is named.
mkdir -p "$work/s"
scene() { printf 'jostle: 1\nplaces: {yard: {polygon: [[0, 0], [5, 0], [5, 5], [0, 5]]}}\ngroups: {g: {behaviour: %s, count: 3, fill: grid, in: yard}}\n' "$1" >"$work/s/scene.yaml"; }
hostile() { # NAME STATUS TEXT LUA
    printf '%s\n' "$4" >"$work/s/bad.lua"; scene bad.lua
    expect "$1" "$2" "$3" timeout 20 "$JOSTLE" run "$work/s/scene.yaml" --steps 20 --quiet
}
sheet() { printf 'return machine { name = "m", start = "A", states = { A = { steer = hold, on_enter = function(me) end, { to = "A", when = function(me) %s end } } } }' "$1"; }
hostile "loops for ever while loading" 3 "too long" 'while true do end'
hostile "eats memory while loading" 3 "memory" 'local t = {} for i = 1, 1e9 do t[i] = {i} end'
hostile "throws while loading" 3 "boom" 'error("boom")'
hostile "returns nothing" 3 "must return one machine" 'local x = 1'
hostile "compiled code" 3 "compiled Lua" "$(printf '\033Lua')"
hostile "loops for ever in a hook" 1 "too long" "$(sheet 'while true do end')"
hostile "eats memory in a hook" 1 "was stopped" "$(sheet 'local s = "x" for i = 1, 40 do s = s .. s end')"
hostile "throws a table in a hook" 1 "error needs a text" "$(sheet 'error({})')"
hostile "returns nonsense" 1 "s/bad.lua:1: a \`when\` function must return true or false" "$(sheet 'return 7')"
hostile "recurses without end" 1 "m > state A" "$(sheet 'local function f() return 1 + f() end return f() > 0')"
hostile "reads files" 3 "unknown word 'io'" 'local f = io.open("/etc/passwd") return machine {}'
hostile "leaves its folder" 3 "not a plain name" 'require "../../secret"'
hostile "NaN for mass" 3 "mass must be" 'return machine { name = "m", start = "A", defaults = { mass = 0/0 }, states = { A = {} } }'
hostile "a misspelt word" 3 "Did you mean 'stuck'" 'return machine { name = "m", start = "A", states = { A = { { to = "A", when = stuk(3) } } } }'

sheet 'return false' >"$work/s/cost.lua"; scene cost.lua
expect "the cost of functions is printed" 0 "plain Lua functions: 63 calls" "$JOSTLE" run "$work/s/scene.yaml" --steps 20

# Traces, profiles, signals, and defaults of keys that the scene omits.
printf 'jostle: 1\nplaces: {yard: {polygon: [[0, 0], [5, 0], [5, 5], [0, 5]]}}\ngroups: {g: {behaviour: told.lua, count: 30, fill: grid, in: yard}}\n' >"$work/s/told.yaml"
cat >"$work/s/told.lua" <<'END'
return machine { name = "told", start = "Go", defaults = { speed = 1 }, states = {
  Go = { steer = hold, on_enter = function(me) local s = 0 for i = 1, 2000 do s = s + i end end,
    { to = "Stay", when = near(nearest("anyone"):in_state("Go"), 3) & after(0.2) } },
  Stay = { steer = hold, on_enter = function(me) me.signal("money", 5) end } } }
END
expect "a trace shows the whole condition" 1 'when near(anyone:in_state("Go"), 3) is true and after(0.2) is true' "$JOSTLE" run "$work/s/told.yaml" --for 0.5 --trace 1 --quiet
grep -qF "told.lua:4: a signal is a name and carries no value" "$work/out"; verdict "a signal with a value is refused with its line" $?
"$JOSTLE" run "$work/s/told.yaml" --steps 1 --quiet --profile-lua 2>&1 | sed -n "s/.*told.lua): .* \([0-9.]*\) % of the steps/\1/p" | awk '{exit !($1 > 0 && $1 <= 100)}'
verdict "shares of functions add up to the whole, also of those called when people come in" $?
# Sixteen people, one of whom costs a thousand times as much as another; the timed calls (one in 64) must not always hit it.
cat >"$work/s/work.lua" <<'END'
local lib = {}
local function count(n) local s = 0 for i = 1, n do s = s + i end return s end
function lib.wait(me) return count(me.id == 0 and 5000 or 5) < 0 end
return lib
END
cat >"$work/s/odd.lua" <<'END'
local lib = require "work"
return machine { name = "odd", start = "Go", states = {
  Go = { steer = hold, on_enter = function(me) lib.wait(me) end,
    { to = "Stay", when = lib.wait }, { to = "Go", when = function(me) return lib.wait(me) end } },
  Stay = { steer = hold } } }
END
printf 'jostle: 1\nplaces: {yard: {polygon: [[0, 0], [9, 0], [9, 9], [0, 9]]}}\ngroups: {g: {behaviour: odd.lua, count: 16, fill: grid, in: yard}}\n' >"$work/s/odd.yaml"
for threads in 1 2 4; do
    "$JOSTLE" run "$work/s/odd.yaml" --steps 100 --threads $threads --quiet --profile-lua 2>&1 |
        awk '/ calls .* ns each .* %/ {sum += $(NF - 1); n++} /^the rest of the steps/ {rest = $(NF - 1)}
            END {exit !(n == 3 && rest >= 0 && sum + rest > 99.9 && sum + rest < 100.1)}'
    verdict "shares of functions and of the rest of the steps sum to 100 %, $threads threads" $?
done
expect "a default value in a table that the scene omits is found" 0 "speed of agent 1 at 0.00 s, in state Go: 1" "$JOSTLE" mod why speed "$work/s/told.yaml" --agent 1
expect "  and can be set" 0 '"agents": 30' "$JOSTLE" run "$work/s/told.yaml" --for 0.1 --quiet --summary - --set groups.g.set.speed=2
expect "  and a misspelt one is refused with the nearest name" 3 "Did you mean 'speed'" "$JOSTLE" run "$work/s/told.yaml" --for 0.1 --quiet --set groups.g.set.sped=2

# Reload while running: a valid change replaces the running version, an invalid one does not.
cp behaviours/stander.lua "$work/s/live.lua"; scene live.lua
"$JOSTLE" run "$work/s/scene.yaml" --steps 900000000 --watch --quiet >"$work/watch" 2>&1 &
pid=$!
sleep 0.7; sed -i 's/perception = 1.5/perception = 2.5/' "$work/s/live.lua"
sleep 0.7; echo 'return machine {' >"$work/s/live.lua"
sleep 0.7; kill -INT $pid 2>/dev/null; wait $pid
# On a terminal files are watched by default.
if command -v script >/dev/null; then
    cp behaviours/stander.lua "$work/s/live.lua"
    timeout 4 script -qec "timeout 3 $JOSTLE run $work/s/scene.yaml --steps 900000000" /dev/null >"$work/terminal" 2>&1 </dev/null &
    pid=$!
    sleep 1; sed -i 's/perception = 1.5/perception = 2.5/' "$work/s/live.lua"
    wait $pid
    grep -q 'version 1 (reload 1) is live' "$work/terminal"; verdict "files are watched by default on a terminal" $?
fi
grep -q 'version 1 (reload 1) is live' "$work/watch"; verdict "a valid change replaces the running version" $?
grep -q 'Version 1 (reload 1) keeps running' "$work/watch"; verdict "an invalid change leaves the old version running" $?

# The last lines of a run sum it up; troubles are reported when they occur.
printf 'jostle: 1\ntitle: One\nduration: 12\nplaces: {yard: {polygon: [[0, 0], [4, 0], [4, 4], [0, 4]]}, out: {point: [9, 2], radius: 1}}\ngroups: {g: {behaviour: walker.lua, at: [[1, 1]], set: {goal: out}}}\nsinks: [{at: out}]\n' >"$work/one.yaml"
expect "a run ends with a paragraph" 0 "One, 12.0 s: 1 person in all; 1 left (out 1), the last at" "$JOSTLE" run "$work/one.yaml" --data "$work/one"
grep -qF "and nobody is inside. Files: tables" <(tr '\n' ' ' <"$work/out") && grep -q "1 agent$" "$work/out" && ! grep -q "1 agents" "$work/out"; verdict "the paragraph names the files, and says '1 agent'" $?
printf 'jostle: 1\ntitle: Shut\nduration: 45\nplaces: {lane: {polygon: [[0.5, 0.2], [9, 0.2], [9, 0.8], [0.5, 0.8]]}, street: {polygon: [[12, 0], [14, 0], [14, 1], [12, 1]]}}\nwalls:\n  - {line: [[11, 0], [0, 0], [0, 1], [11, 1]]}\n  - {line: [[10.5, 0], [10.5, 1]]GATE}\ngroups: {g: {behaviour: walker.lua, count: 14, fill: random, in: lane, set: {goal: street}}}\n' >"$work/lane.yaml"
sed 's/GATE/, name: gate/' "$work/lane.yaml" >"$work/never.yaml"; { cat "$work/never.yaml"; echo 'events: [{at: 44.9, open: gate}]'; } >"$work/gate.yaml"; sed 's/GATE//; s/\[11, 0\], \[0, 0\]/[11, 1], [11, 0], [0, 0]/' "$work/lane.yaml" >"$work/shut.yaml"
expect "a crowd that stands still is reported with its position" 0 "people who want to get on have stood still for 30 s, most of them about (" "$JOSTLE" run "$work/gate.yaml"
grep -qE "most of them about \((9|10)\.[0-9], 0\.[0-9]\) m" "$work/out" && grep -q "A crowd of .* people stood still from" <(tr '\n' ' ' <"$work/out") && grep -q "14 people are inside: Walk 14" <(tr '\n' ' ' <"$work/out") && ! grep -q "cannot reach" "$work/out"; verdict "it is reported again at the end; a gate counts as a way" $?
cat >"$work/turned.yaml" <<'END'
jostle: 1
places: {here: {point: [0, 0], radius: 2}, there: {point: [8, 0], radius: 1}}
groups: {people: {count: 3, in: here, journey: [{exit: there}]}}
probes: {line: {flow: [[4, 4], [4, -4]]}, other: {flow: [[4, -4], [4, 4]]}}
END
"$JOSTLE" run "$work/turned.yaml" --for 12 --report "$work/turned" --quiet >"$work/out" 2>&1
[ "$(wc -l <"$work/out")" = 1 ]; verdict "a quiet run prints the path of its report, and nothing of gnuplot's output" $?
"$JOSTLE" run "$work/turned.yaml" --for 12 2>&1 | tr '\n' ' ' >"$work/out"
grep -qE "line of probe (line|other) was crossed 3 times, always against the direction" "$work/out" && [ "$(grep -o 'always against' "$work/out" | wc -l)" = 1 ]; verdict "a flow line crossed only from the wrong side is reported" $?
expect "a goal that cannot be reached is reported during the run" 1 "warning: 14 people cannot reach street: no way leads there from" "$JOSTLE" run "$work/shut.yaml" --for 6
grep -q "1 warning was given" <(tr '\n' ' ' <"$work/out"); verdict "it is reported as a warning" $?
expect "  and the run ends with status 1 and the cause" 1 "nobody can reach 'street': walls lie between; 14 people of group 'g'" "$JOSTLE" run "$work/shut.yaml" --for 6 --quiet
expect "  and check warns of it" 0 "shut.yaml:8:10: warning: nobody of group 'g' can reach 'street'" "$JOSTLE" check "$work/shut.yaml"
expect "  not if an event opens a gate on the way" 0 "nothing wrong" "$JOSTLE" check "$work/gate.yaml"
expect "  but if nothing opens the gate" 0 "never.yaml:8:10: warning: nobody of group 'g' can reach 'street': gate 'gate' is closed at (10" "$JOSTLE" check "$work/never.yaml"
grep -q ", and nothing opens it. Add an event" <(tr '\n' ' ' <"$work/out"); verdict "  with a remedy" $?
expect "people kept by a gate at the end are reported in the last lines" 0 "14 people wait to get to 'street', the first since 1 s: gate 'gate' is closed" sh -c "'$JOSTLE' run '$work/gate.yaml' --for 12 --summary '$work/kept.json' 2>&1 | tr '\n' ' '"
grep -q '"kept": \[ *{"from": "street", "cause": "gate", "by": "gate", "people": 14, "since_s": 1' <(tr -s '\n ' ' ' <"$work/kept.json"); verdict "  and counted" $?
expect "  and the status is 1 if nothing opens the gate" 1 "nobody can reach 'street': gate 'gate' is closed at (10.5, 0.5) m, and nothing opens it; 14 people of group 'g'" "$JOSTLE" run "$work/never.yaml" --for 6 --quiet
# A doorway that a body fills, that is too narrow for some, or that a driven door shuts for a while.
way() { # NAME GAP BODIES GROUP EVENTS...
    printf 'jostle: 1\ntitle: Way\nduration: 20\nwalls:\n  - {line: [[0, 0], [10, 0], [10, 4], [0, 4]], closed: true}\n  - {line: [[6, 0], [6, %s]]}\n  - {line: [[6, 4], [6, %s]]}\nplaces: {hall: {polygon: [[1, 1], [5, 1], [5, 3], [1, 3]]}, out: {point: [8, 2], radius: 0.5}}\n%sgroups: {g: {at: [[4, 1.2], [3, 2.8]], %s journey: [{exit: out}]}}\n%s' $2 "$3" "$4" "${5:-}" >"$work/$1.yaml"
}
crate='bodies: [{name: crate, shape: {box: {size: [1, 1.6, 1.9]}}, mass: 0, at: [6, 2, 0.95]}]\n'
door='bodies: [{name: door, shape: {box: {size: [0.2, 1.6, 1.9]}}, kinematic: true, at: [6, 2, 0.95]}]\n'
way filled "1.2 2.8" "$(printf "$crate")
" ""
way driven "1.2 2.8" "$(printf "$door")
" "" "events: [{at: 8, move: door, velocity: [0, 1, 0]}]
"
way narrow "1.8 2.2" "" "set: {radius: 'uniform(0.19, 0.191)'},"
way broad "1.8 2.2" "" "set: {radius: 0.5},"
expect "check names a body that fills a doorway" 0 "nobody of group 'g' can reach 'out': the body 'crate' fills the way at (6.0, 2.0) m" "$JOSTLE" check "$work/filled.yaml"
expect "  a run names it too" 1 "nobody can reach 'out': the body 'crate' fills the way at (6.0, 2.0) m; 2 people of group 'g'" "$JOSTLE" run "$work/filled.yaml" --for 6 --quiet
expect "a driven door that opens later is no fault" 0 "nothing wrong" "$JOSTLE" check "$work/driven.yaml"
expect "  while it is closed the run names it" 0 "2 people wait to get to 'out', the first since 1 s: the body 'door' shuts the way" sh -c "'$JOSTLE' run '$work/driven.yaml' --for 6 2>&1 | tr '\n' ' '"
expect "  and people leave when it opens" 0 "2 left" "$JOSTLE" run "$work/driven.yaml"
! grep -q "cannot reach" "$work/out"; verdict "  without a warning" $?
expect "people who fit through a gap leave" 0 "2 left" "$JOSTLE" run "$work/narrow.yaml"
expect "  without a warning" 0 "nothing wrong" "$JOSTLE" check "$work/narrow.yaml"
expect "check warns of people too broad for a gap, with the width that they need" 0 "the way is narrower than they are at (6" "$JOSTLE" check "$work/broad.yaml"
grep -q "Leave a gap of 1.00 m at least, twice a radius" <(tr '\n' ' ' <"$work/out"); verdict "  by the radius of each person" $?
expect "  a run names it too" 1 "nobody can reach 'out': the way is narrower than they are at (6" "$JOSTLE" run "$work/broad.yaml" --for 6 --quiet
sed -i "s/journey/profiles: {broad: {share: 1, set: {radius: 0.5}}, slim: {share: 1, set: {radius: 0.2}}}, journey/; s/set: {radius: 0.5}, p/p/; s/at: .* p/in: hall, count: 6, spacing: 1.1, p/" "$work/broad.yaml"
expect "  with their number" 0 "of the 6 people of group 'g' cannot reach 'out': the way is narrower" "$JOSTLE" check "$work/broad.yaml"
# A hall with a gate in the east that nothing opens, and one in the west that opens; then one behind the other.
cat >"$work/west.yaml" <<'END'
jostle: 1
places: {hall: {polygon: [[1, 1], [5, 1], [5, 5], [1, 5]]}, out: {point: [10, 3]}}
walls:
  - {line: [[6, 2], [6, 0], [0, 0], [0, 2]]}
  - {line: [[6, 4], [6, 6], [0, 6], [0, 4]]}
  - {line: [[6, 2], [6, 4]], name: east}
  - {line: [[0, 2], [0, 4]], name: west}
groups: {g: {count: 3, in: hall, journey: [{exit: out}]}}
events: [{at: 20, open: west}]
END
sed 's/\[0, 0\], \[0, 2\]/[0, 0], [0, 6]/; s/\[6, 6\], \[0, 6\], \[0, 4\]/[6, 6], [0, 6]/; s/\[\[0, 2\], \[0, 4\]\]/[[5.5, 0], [5.5, 6]]/' "$work/west.yaml" >"$work/row.yaml"
expect "a gate that nothing opens is no fault if another way leads through one that opens" 0 "nothing wrong" "$JOSTLE" check "$work/west.yaml"
expect "  and people wait for that one" 0 "3 people wait to get to 'out', the first since 1 s: gate 'west' is closed" sh -c "'$JOSTLE' run '$work/west.yaml' --for 6 2>&1 | tr '\n' ' '"
"$JOSTLE" run "$work/west.yaml" --for 6 --quiet; verdict "  with status 0" $?
expect "  it is a fault if it is behind the one that opens" 0 "nobody of group 'g' can reach 'out': gate 'east' is closed at (6.0, 3.0) m, and nothing opens it" "$JOSTLE" check "$work/row.yaml"
expect "  a run names it too" 1 "nobody can reach 'out': gate 'east' is closed" "$JOSTLE" run "$work/row.yaml" --for 6 --quiet
printf 'jostle: 1\nbounds: [[0, 0], [12, 4]]\nperiodic: x\nplaces: {src: {polygon: [[8, 1], [11, 1], [11, 3], [8, 3]]}, out: {point: [2, 2]}}\nwalls:\n  - {line: [[0, 0], [0, 4]], name: seam}\n  - {line: [[0, 0], [12, 0]]}\n  - {line: [[0, 4], [12, 4]]}\n  - {line: [[6, 0], [6, 4]]}\ngroups: {g: {count: 3, in: src, journey: [{exit: out}]}}\n' >"$work/seam.yaml"
expect "  also at a joined edge, from its other side" 0 "nobody of group 'g' can reach 'out': gate 'seam' is closed at (0.0, 2.0) m, and nothing opens it" "$JOSTLE" check "$work/seam.yaml"
printf 'jostle: 1\nwalls: [{line: [[0, 0], [12, 0], [12, 6], [0, 6]], closed: true}, {solid: [[8, 2], [10, 2], [10, 4], [8, 4]]}]\nscenery:\n  - {kind: bench, at: [[14, 2], [9, 3], [4, 3]]}\n  - {kind: hedge, through: [[3, 1], [3, 5]]}\n  - {kind: parapet, through: [[0, 0], [12, 0]]}\n  - {kind: ring, at: [4, 3]}\ngroups: {g: {behaviour: stander.lua, at: [[1, 1]]}}\n' >"$work/walked.yaml"
expect "check warns of solid scenery that people can walk through" 0 "walked.yaml:4:5: warning: people can walk through this bench, at (" "$JOSTLE" check "$work/walked.yaml"
expect "  also along a line" 0 "walked.yaml:5:5: warning: people can walk through this hedge, at (3.0, 1.0) m" "$JOSTLE" check "$work/walked.yaml"
expect "  not of what stands outside, in a wall or on one, or lies flat" 0 "0 errors, 2 warnings" "$JOSTLE" check "$work/walked.yaml"
! "$JOSTLE" run "$work/walked.yaml" --steps 1 2>&1 | grep -q "walk through"; verdict "  a run does not look for it" $?
sed 's/{exit: out}/{until: alarm}, {wait: 1, open: east}, {exit: hall}/' "$work/west.yaml" >"$work/waits.yaml"
expect "check warns of a journey step that waits for a gate that nothing opens" 0 "waits.yaml:8:60: warning: gate 'east' is closed, and nothing opens it" "$JOSTLE" check "$work/waits.yaml"
expect "  or for a signal that nothing gives" 0 "waits.yaml:8:44: warning: no machine of the scene gives the signal 'alarm'" "$JOSTLE" check "$work/waits.yaml"
sed 's/open: east/open: west/' "$work/waits.yaml" >"$work/opens.yaml"
"$JOSTLE" check "$work/opens.yaml" | grep -q "is closed, and nothing"; [ $? = 1 ]; verdict "  not if an event opens it" $?
printf 'jostle: 1\nduration: 3\nwalls: [{solid: [[5, 0], [9, 0], [9, 4], [5, 4]]}]\nplaces: {hall: {polygon: [[1, 1], [4, 1], [4, 3], [1, 3]]}, desk: {polygon: [[6, 1], [8, 1], [8, 3], [6, 3]]}}\ngroups: {g: {count: 2, in: hall, journey: [{to: desk}]}}\n' >"$work/desk.yaml"
expect "a run warns of a journey step whose place is inside a wall" 0 "nobody can be inside 'desk': it lies in a wall" "$JOSTLE" run "$work/desk.yaml"
for who in 'at: [[1, 0.5], [20, 0.5]]|1 of the 2 people of group' 'count: 0|who comes in at'; do
    sed "s/count: 14, fill: random, in: lane/${who%%|*}/; \$ a sources: [{at: lane, like: g, rate: 1}]" "$work/shut.yaml" >"$work/some.yaml"
    expect "  also of some members and of sources: ${who#*|}" 0 "warning: ${who#*|}" "$JOSTLE" check "$work/some.yaml"
done
cat >"$work/pillar.yaml" <<'END'
jostle: 1
places: {hall: {polygon: [[0, 0], [4, 0], [4, 4], [0, 4]]}, pillar: {polygon: [[7, 1], [9, 1], [9, 3], [7, 3]]}}
walls: [{solid: [[6.5, 0.5], [9.5, 0.5], [9.5, 3.5], [6.5, 3.5]]}]
groups: {people: {count: 3, in: hall, journey: [{exit: pillar}]}}
END
expect "check warns of a goal inside a wall" 0 "pillar.yaml:4:49: warning: nobody can be inside 'pillar': it lies in a wall" "$JOSTLE" check "$work/pillar.yaml"
for other in 's/9.5, 3.5\], \[6.5/8.9, 3.5], [6.5/; s/9.5, 0.5/8.9, 0.5/|a part of which is free' 's/3.5\]\]}/3.5]], name: gate}/|that opens'; do
    sed "${other%%|*}" "$work/pillar.yaml" >"$work/free.yaml"
    expect "  not of a goal ${other#*|}" 0 "nothing wrong" "$JOSTLE" check "$work/free.yaml"
done
printf 'jostle: 1\nbounds: [[0, 0], [10, 6]]\nperiodic: x\nwalls: [{line: [[0, 0], [10, 0]]}, {line: [[0, 1], [0, 6]]}]\ngroups: {g: {behaviour: stander.lua, at: [[5, 3]]}}\n' >"$work/joined.yaml"
expect "a wall at a joined edge is treated as any wall" 0 "nothing wrong" "$JOSTLE" check "$work/joined.yaml"
sed 's/walker.lua/stander.lua/; s/, set: {goal: street}//' "$work/shut.yaml" >"$work/stay.yaml"
cp behaviours/stander.lua "$work"
expect "  not of people who go nowhere" 0 "nothing wrong" "$JOSTLE" check "$work/stay.yaml"
printf 'jostle: 1\nduration: 25\nplaces: {near: {point: [4, 0], radius: 1}, far: {point: [90, 0], radius: 1}}\ngroups: {g: {behaviour: hinted.lua, at: [[0, 0]]}}\n' >"$work/hinted.yaml"
printf 'return machine { name = "hinted", version = 1, start = "Go", states = {\n  Go = { steer = seek "near",\n    { to = "Done", when = inside "far" } },\n  Done = { steer = hold } } }\n' >"$work/hinted.lua"
expect "a run of full length hints at unused states and transitions, with file and line" 0 "hinted.lua:3: nobody was ever in state 'Done'" "$JOSTLE" run "$work/hinted.yaml"
grep -q '^Hints on the behaviours:$' "$work/out"; verdict "  under a heading" $?
expect "a shorter run gives no hints" 0 "1 person" "$JOSTLE" run "$work/hinted.yaml" --for 20
! grep -q '^Hints' "$work/out"; verdict "  nor their heading" $?
cat >"$work/torsos.yaml" <<'END'
jostle: 1
step: 0.01
duration: 1
bounds: [[0, 0], [20, 10]]
periodic: both
groups:
  roomy: {behaviour: stander.lua, at: [[3, 5]], set: {breadth: 0.45, depth: 0.25, radius: 0.5}}
  deep: {behaviour: stander.lua, at: [[5, 5]], set: {breadth: 0.25, depth: 0.45, radius: 0.15}}
  beside: {behaviour: stander.lua, at: [[8, 5], [8, 5.16]], set: {breadth: 0.29, depth: 0.25, radius: 0.1}}
  apart: {behaviour: stander.lua, at: [[14, 5], [14, 5.33]], set: {breadth: 0.45, depth: 0.25}}
  behind: {behaviour: stander.lua, at: [[11, 5], [11, 5.33]], facing: 90, set: {breadth: 0.45, depth: 0.25}}
  stout: {behaviour: stander.lua, at: [[17, 5]], set: {depth: 0.6}}
  tiny: {behaviour: stander.lua, at: [[17, 2]], set: {breadth: 0.03, depth: 0.02}}
  least: {behaviour: stander.lua, at: [[14, 2]], set: {breadth: 0.02, depth: 0.02, radius: 0.02}}
  seam: {behaviour: stander.lua, at: [[19.92, 2], [0.08, 2]], set: {breadth: 0.29, depth: 0.25, radius: 0.1}}
  corner: {behaviour: stander.lua, at: [[0.06, 0.06], [19.94, 9.94]], set: {breadth: 0.29, depth: 0.25, radius: 0.1}}
END
"$JOSTLE" check "$work/torsos.yaml" 2>&1 | tr -s '\n ' ' ' >"$work/out"
unsaid=0
for said in "of group 'roomy' keep room for a disc of 0.50 m" "of group 'deep' have a breadth of 0.25 m and a depth of 0.45 m" \
    "of group 'stout' have a breadth of 0.45 m and a depth of 0.60 m" "radius: 0.02 goes with a breadth of 0.03" \
    "2 of the 2 people of group 'beside' begin in others, up to 0.09 m deep" \
    "2 of the 2 people of group 'seam' begin in others, up to 0.09 m deep" \
    "2 of the 2 people of group 'corner' begin in others, up to 0.08 m deep" "nothing wrong, 7 notes"; do
    grep -qF "$said" "$work/out" || { unsaid=1; echo "# not said: $said"; }
done
verdict "notes on torsos name odd measures, and who begins in others however they turn" $unsaid
for scene in evacuation tour station catch rimea-10 families metro gates; do
    "$JOSTLE" run scenes/$scene.yaml 2>&1 | grep -A9 '^Hints'
done >"$work/hints"
[ ! -s "$work/hints" ]; verdict "shipped scenes give no hints" $?; head -5 "$work/hints"
sed "s/at: \[\[1, 1\]\]/at: [[1, 1], [1, 1], [1, 1]]/" "$work/one.yaml" >"$work/three.yaml"
expect "people inside walls are reported before the first step" 0 "of the 3 people of group 'g' were placed at a wall or deep in others" "$JOSTLE" run "$work/three.yaml" --for 1
printf 'jostle: 1\nduration: 1\ngroups: {g: {behaviour: walker.lua, at: [[0, 0], [0, 0]], set: {goal: p}}}\nplaces: {p: {point: [9, 0], radius: 1}}\nevents: [{at: 0.5, signal: unheard}]\n' >"$work/warned.yaml"
"$JOSTLE" check "$work/warned.yaml" >"$work/out" 2>&1; tail -1 "$work/out" | grep -q '^0 errors, 1 warning, 1 note$'; verdict "a check with warnings does not say 'nothing wrong'" $?
# A behaviour that a scene names, too, is one file however it is reached.
twice=$work/twice program=$(realpath "$JOSTLE")
mkdir -p "$twice/lib"
printf 'local pace = require "lib/pace"\nreturn machine { name = "w", start = "A", states = {\n  A = { steer = hold, speed = pace },\n  Lost = { steer = hold } } }\n' >"$twice/w.lua"
echo 'return 1.2' >"$twice/lib/pace.lua"
printf 'jostle: 1\nduration: 1\ngroups: {g: {behaviour: w.lua, at: [[0, 0]]}}\n' >"$twice/a.yaml"
for paths in . "a.yaml ." ". a.yaml" ". $twice" "w.lua ./w.lua ." "../twice ."; do
    (cd "$twice" && "$program" check $paths) >"$work/out" 2>&1
    [ "$(grep -c "nothing leads to state 'Lost'" "$work/out")" = 1 ] && tail -1 "$work/out" | grep -q '^0 errors, 1 warning'; verdict "check gives each warning once: $paths" $?
    cp "$twice/a.yaml" "$twice/b.yaml"
done
(cd "$twice" && "$program" check .) | grep -q '^w.lua:4:3: warning:'; verdict "  with the path by which the scene names the file" $?

printf 'return machine { name = "asks", start = "A", states = { A = { steer = hold,\n  { to = "B", when = near(nearest("people"):in_state("Aa"), 2) } }, B = { removes = true } } }\n' >"$work/asks.lua"
printf 'jostle: 1\ngroups: {g: {behaviour: asks.lua, at: [[0, 0], [3, 0]], tags: [people]}}\n' >"$work/asks.yaml"
expect "check warns of a state that no machine of the scene has, at its line" 0 "asks.lua:2:54: warning: no machine of the scene has a state 'Aa'. Did you mean 'A'?" "$JOSTLE" check "$work/asks.yaml"

# ---- folders and files that cannot be read ----
mkdir -p "$work/linked" "$work/deep/2/3/4/5/6/7/8/9"; ln -s / "$work/linked/away"; ln -s itself "$work/linked/itself"
for command in check; do
    expect "$command: an unreadable folder is an error" 3 "linked/away: the folder cannot be read: Permission denied. Give its path" "$JOSTLE" $command "$work/linked"
    grep -q "linked/itself: Too many levels of symbolic links" "$work/out"; verdict "  also an unreadable file" $?
    expect "  also a folder that is too deep" 0 "/8/9: warning: folders are checked 8 levels deep, so not this one" "$JOSTLE" $command "$work/deep"
done
mkfifo "$work/pipe.yaml"; head -c 100000 /dev/urandom >"$work/noise.yaml"
expect "check refuses a pipe, random bytes and an empty file" 3 "3 errors" timeout 20 "$JOSTLE" check "$work/pipe.yaml" "$work/noise.yaml" "$work/nothing.yaml"
