# Falls: a crowd that collapses where its people can lose their balance, and does not where they cannot.
. tests/scenes/lib.sh
# falls_in NAME ARGS...: runs the scene, and prints its count NAME
falls_in() {
    local name=$1; shift
    "$JOSTLE" run scenes/crowd-collapse.yaml --quiet --for 25 --summary "$work/c.json" "$@" 2>/dev/null
    sed -n "s/.*\"$name\": \([0-9]*\).*/\1/p" "$work/c.json"
}
between "people in a pressing crowd fall onto those who were thrown" "$(falls_in falls)" 60 2000
between "  and many of the 220 lie at a time" "$(falls_in most_fallen)" 40 220
between "with a balance of 0 nobody falls" "$(falls_in falls --set groups.people.set.balance=0)" 0 0
between "without forces of others only those fall who were thrown" "$(falls_in falls --set forces.enabled=false)" 1 20
between "where nobody is thrown nobody falls" "$(falls_in falls --set events.0.at=1000)" 0 0
"$JOSTLE" run scenes/crowd-collapse.yaml --for 6 2>&1 | tr '\n' ' ' | grep -qE 'There were [0-9]+ falls, [0-9]+ people who lay at the same time'
verdict "the last lines count falls" $?
"$JOSTLE" run scenes/crowd-collapse.yaml --quiet --for 6 --record "$work/c.sqlite" --report "$work/report" --no-half-step 2>/dev/null
between "a recording tells who lies" "$(sqlite3 "$work/c.sqlite" "SELECT count(DISTINCT id) FROM trajectory_data WHERE fallen > 0")" 40 220
grep -q 'Who fell' "$work/report/index.html"; verdict "a report says how many fell" $?
grep -q 'contacts are those of rigid outlines' "$work/report/index.html"; verdict "  and what shape of people contacts assume" $?
"$JOSTLE" render "$work/c.sqlite" --out "$work/c.svg" --at 5 2>/dev/null
grep -q '>fallen<' "$work/c.svg"; verdict "a picture shows who has fallen" $?
same_hash "falls do not depend on threads" "$(hash_of "$JOSTLE" scenes/crowd-collapse.yaml --for 10 --threads 1)" \
    "$(hash_of "$JOSTLE" scenes/crowd-collapse.yaml --for 10 --threads 3)"
# People who are thrown, help each other up, and step back beside others who do not.
cat >"$work/helper.lua" <<'END'
local lying = nearest("anyone"):fallen()
return machine { name = "helper", start = "Go", own = { goal = "post" },
  defaults = { speed = 1.3, time_gap = 0.25, balance = 0.001, rise = 0 },
  states = {
    Go = { steer = seek(own.goal), push = 60, { to = "Help", when = sees(lying) }, { to = "Down", when = fallen } },
    Down = { { to = "Go", when = ~fallen } },
    Help = { grasp = lying, steer = seek(lying), { to = "Go", when = after(2) }, { to = "Down", when = fallen } },
  } }
END
cat >"$work/helpers.yaml" <<'END'
jostle: 1
duration: 8
places: {yard: {polygon: [[-6, -6], [6, -6], [6, 6], [-6, 6]]}, post: {point: [12, 0], radius: 0.6}}
groups: {people: {behaviour: helper.lua, count: 120, in: yard, set: {goal: post}}}
events: [{at: 2, push: yard, force: [1500, 0], lasts: 0.2}]
END
same_hash "falls do not depend on the instruction set" "$(hash_of "$JOSTLE" "$work/helpers.yaml")" \
    "$(hash_of "$JOSTLE" "$work/helpers.yaml" --isa scalar)"
"$JOSTLE" run scenes/crowd-collapse.yaml --quiet --for 5 --checkpoint 5 --checkpoint-dir "$work/cp" 2>/dev/null
same_hash "falls go on from a checkpoint" "$(hash_of "$JOSTLE" scenes/crowd-collapse.yaml --for 10)" \
    "$("$JOSTLE" resume "$work/cp/latest.checkpoint" --for 10 --quiet --summary - 2>/dev/null | figure hash)"
