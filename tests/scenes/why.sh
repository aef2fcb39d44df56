# Why agents stay in their states: the command `why`, of agents, groups and states, from the beginning and from checkpoints.
. tests/scenes/lib.sh
mkdir "$work/school"
cat >"$work/school/pupil.lua" <<'END'
return machine { name = "pupil", start = "Walk", defaults = { perception = 4 },
  states = {
    Walk = { steer = seek "desk",
      { to = "Lesson", when = near("desk", 3) } },
    Lesson = { steer = hold,
      { to = "Break", when = heard "bell" & after(5) },
      { to = "Hide", when = near(nearest "teacher", 2) } },
    Break = { steer = hold },
    Hide = { steer = hold },
  } }
END
cat >"$work/school/school.yaml" <<'END'
jostle: 1
duration: 30
places: {desk: {point: [0, 0]}}
groups:
  pupils: {behaviour: pupil.lua, at: [[0, 0], [1, 0], [0, 1], [2, 2], [30, 0], [-28, 0]]}
  teachers: {behaviour: teacher.lua, tags: [teacher], at: [[60, 0]]}
END
echo 'return machine { name = "teacher", start = "Stand", states = { Stand = { steer = hold } } }' >"$work/school/teacher.lua"
school=$work/school/school.yaml
expect "an agent is explained: its state and since when" 0 "30.00 s: agent 0 of group pupils (machine pupil) has been in state Lesson for 30.00 s" "$JOSTLE" why "$school" --agent 0 --quiet
grep -q 'no *heard("bell") *nobody has called it so far' "$work/out"; verdict "  a signal that nobody called" $?
grep -q 'yes *after(5) *30 s' "$work/out"; verdict "  a term that holds, with its value" $?
grep -q 'no *near(teacher, 2) *the only one is agent 6 (in Stand), 60 m away, beyond its perception of 4 m' "$work/out"; verdict "  a target that is not there" $?
expect "people of a state are counted by term" 0 "0 of 6  heard" "$JOSTLE" why "$school" --state Lesson --at 30 --quiet
expect "of an agent, the transitions to a state alone" 0 "no   heard" "$JOSTLE" why "$school" --agent 0 --to Break --at 30 --quiet
! grep -q -e '-> Hide' "$work/out"; verdict "  without the others" $?
expect "  or the shortest way there" 0 "The shortest way to Break is Walk -> Lesson -> Break; its transitions to Lesson:" "$JOSTLE" why "$school" --agent 4 --to Break --at 2 --quiet
expect "  or that there is none" 0 "No transitions lead from Lesson to Stand, which is a state of another behaviour." "$JOSTLE" why "$school" --agent 0 --to Stand --at 30 --quiet
expect "people of a state are counted by term at another time, too" 0 "4 people are in Lesson" "$JOSTLE" why "$school" --state Lesson --at 1 --quiet
expect "  a state that nobody is in: who could go there" 0 "nobody in Hide; who could go to Hide:" "$JOSTLE" why "$school" --state Hide --at 30 --quiet
expect "  the same of those in a state" 0 "6 people are in Lesson" "$JOSTLE" why "$school" --state Lesson --to Break --quiet
! grep -q "Hide" "$work/out"; verdict "    without the other transitions" $?
expect "people of a group, state by state" 0 "2 people are in Walk" "$JOSTLE" why "$school" --group pupils --at 2 --quiet
"$JOSTLE" why "$school" --agent 0 --at 3 --json 2>/dev/null | python3 -c '
import json, sys
why = json.load(sys.stdin)
near, far = why["transitions"]
terms = {t["text"]: t for t in far["when"]["terms"]}
after = terms["after(5)"]
assert (why["agent"], why["state"], why["time"], near["to"], near["misses"], far["to"], far["misses"]) == (0, "Lesson", 3, "Hide", 1, "Break", 2)
assert (after["holds"], after["value"], after["relation"], after["bound"], after["unit"]) == (False, 3, ">=", 5, "s")
assert near["when"]["text"] == "near(teacher, 2)" and near["line"] == 7 and near["file"].endswith("pupil.lua")
'
verdict "--json is an object of transitions and terms" $?
cat >"$work/school/reach.lua" <<'LUA'
return machine { name = "reach", start = "Reach", states = { Reach = { steer = seek(nearest "anyone"), take = nearest "ball", { to = "Reach", when = has(nearest "ball") } } } }
LUA
cat >"$work/school/reach.yaml" <<'END'
jostle: 1
duration: 5
bodies: [{name: ball, shape: {sphere: {radius: 0.1}}, mass: 0.4, at: [1.5, 0, 0.1], tags: [ball]}]
groups: {n: {behaviour: reach.lua, at: [[0, 0]]}}
END
expect "an action that something keeps from its target is told" 0 "  take ball: body 'ball', 1.5 m away: a gap of 1.2 m, reach 0.6 m" "$JOSTLE" why "$work/school/reach.yaml" --agent 0 --quiet
expect "  of a state, too, with steering that leads nowhere" 0 "  agent 0: steering: seek(anyone): there is nobody else in the world; so it stands" "$JOSTLE" why "$work/school/reach.yaml" --state Reach --quiet
"$JOSTLE" run "$work/school/reach.yaml" --set duration=15 2>&1 | tr '\n' ' ' | grep -qF '1 person has stood for 10 s or more, as steering finds no target: 1 in Reach (seek(anyone)). `jostle why SCENE --state "Reach"` says why.'
verdict "  and at the end of a run" $?
"$JOSTLE" run "$work/school/reach.yaml" --set duration=15 --quiet --summary - 2>/dev/null | python3 -c '
import json, sys
assert json.load(sys.stdin)["lost_steering"] == [{"machine": "reach", "state": "Reach", "people": 1, "steering": "seek(anyone)"}]
'
verdict "    also in the summary" $?
"$JOSTLE" why "$work/school/reach.yaml" --agent 0 --json 2>/dev/null | grep -q '"take ball: body .ball., 1.5 m away: a gap of 1.2 m, reach 0.6 m"'; verdict "  and as JSON" $?
expect "progress is shown, on stderr" 0 "" bash -c "'$JOSTLE' why '$school' --agent 0 >/dev/null"
grep -q '30' "$work/out"; verdict "  up to the end" $?
# From a checkpoint, at its time and later, as from the beginning.
(cd "$work" && "$OLDPWD/$JOSTLE" run school/school.yaml --quiet --checkpoint 4 --checkpoint-dir kept)
at=$("$JOSTLE" why --from "$work/kept" --agent 0 --quiet | sed -n '1s/ s: .*//p')
for answer in "--from $work/kept" "$school"; do (cd "$work" && "$OLDPWD/$JOSTLE" why ${answer#$work/} --group pupils --at 29 --quiet 2>/dev/null) | sed 's/([^)]*pupil.lua/(pupil.lua/'; done >"$work/answers"
awk '{lines[NR] = $0} END {for (n = 1; n <= NR / 2; n++) if (lines[n] != lines[n + NR / 2]) exit 1; exit NR < 6}' "$work/answers"
verdict "from a checkpoint (of $at s) the answer is that from the beginning" $?
expect "  before its time it is refused" 2 "after the 2 s asked about" "$JOSTLE" why --from "$work/kept" --agent 0 --at 2
expect "  a scene beside it is refused" 2 "--from goes without SCENE" "$JOSTLE" why "$school" --from "$work/kept" --agent 0
expect "without agent, group or state it is refused" 2 "say about whom: --agent ID, --group NAME, --state NAME or --to NAME" "$JOSTLE" why "$school"
expect "  and with too many" 2 "--agent asks about one agent: it goes with --to, not with --group or --state" "$JOSTLE" why "$school" --agent 1 --group pupils
expect "an agent that is not there is refused" 2 "there is no agent 7 at 30.00 s: 7 came in so far, the last is agent 6" "$JOSTLE" why "$school" --agent 7 --quiet
expect "  a state, with the nearest one" 2 "has no state 'Lessn'. Did you mean 'Lesson'?" "$JOSTLE" why "$school" --state Lessn --quiet
expect "  a group" 2 "has no group 'pupil'. Did you mean 'pupils'?" "$JOSTLE" why "$school" --group pupil --quiet
expect "a broken scene is refused" 3 "Did you mean 'office'?" "$JOSTLE" why offise --agent 1
# The end of a run: states that nobody left, and transitions that never fired; not states without transitions.
expect "a run says which state nobody left" 0 "Nobody left Lesson (6 people in it, since 0 s)" bash -c "'$JOSTLE' run '$school' 2>&1 | tr '\n' ' '"
grep -q 'why SCENE --state Lesson. says what they wait for' "$work/out" && ! grep -q 'Stand (' "$work/out"; verdict "  and how to ask why" $?
"$JOSTLE" run "$school" --quiet --summary - 2>/dev/null | python3 -c '
import json, sys
figures = json.load(sys.stdin)
assert figures["unleft"] == [{"machine": "pupil", "state": "Lesson", "people": 6, "since_s": 0}], figures["unleft"]
assert "never_fired" not in figures
'
verdict "  also in the summary" $?
expect "a run of 5 s is too short to say so" 0 "7 people in all" bash -c "'$JOSTLE' run '$school' --for 5 2>&1 | tr '\n' ' '"
! grep -q 'Nobody left' "$work/out"; verdict "  and says nothing" $?
cat >"$work/school/pupil.lua" <<'END'
local mine = memory { bells = 0 }
return machine { name = "pupil", start = "Walk", defaults = { perception = 4 },
  states = {
    Walk = { steer = hold,
      { to = "Lesson", when = after(6) },
      { to = "Hide", when = mine.bells:above(3) } },
    Lesson = { steer = hold,
      { to = "Walk", when = after(1) } },
    Hide = { steer = hold },
  } }
END
expect "a transition that never fired is named" 0 "Never fired, though people were in the state and left it: Walk -> Hide." bash -c "'$JOSTLE' run '$school' 2>&1 | tr '\n' ' '"
"$JOSTLE" run "$school" --quiet --summary - 2>/dev/null | python3 -c '
import json, sys
figures = json.load(sys.stdin)
assert figures["never_fired"] == [{"machine": "pupil", "from": "Walk", "to": "Hide", "id": "Hide"}] and "unleft" not in figures
'
verdict "  also in the summary" $?
cat >"$work/school/short.lua" <<'LUA'
return machine { name = "short", start = "A", states = { A = { steer = hold, { to = "C", when = now.speed:above(100) }, { to = "B", when = after(3) } },
  B = { steer = hold, { to = "A", when = after(1) } }, C = { steer = hold, { to = "A", when = after(1) } } } }
LUA
"$JOSTLE" run "$work/school/reach.yaml" --set duration=16 --set groups.n.behaviour=short.lua 2>&1 | tr '\n' ' ' | grep -q 'left it: A -> C\.'
verdict "  also of a state that was left three times" $?
# A trace tells between transitions which terms begin and cease to hold.
expect "a trace tells which terms changed" 0 "in Walk, for Lesson: after(6) now holds" bash -c "sed 's/when = after(6)/when = after(6) \& now.x:above(90)/' '$work/school/pupil.lua' >'$work/school/slow.lua';
    '$JOSTLE' run '$school' --set groups.pupils.behaviour=slow.lua --trace 0 --for 8 --quiet"
[ "$(grep -c '^t=' "$work/out")" = 1 ]; verdict "  once each" $?
# Breakpoints end a run, and write a checkpoint that \`why\` and \`resume\` go on from.
sed 's/after(6)/after(6) | now.x:above(0.5)/' "$work/school/pupil.lua" >"$work/school/apart.lua"
apart() { (cd "$work/school" && "$OLDPWD/$JOSTLE" run school.yaml --set groups.pupils.behaviour=apart.lua --quiet "$@" 2>&1); }
[ "$(apart --break 'agent 0 enters Lesson' | grep '^t = ')" = "t = 6.05 s: breakpoint 'agent 0 enters Lesson': agent 0 went from Walk to Lesson, when after(6) is true or now.x 0 > 0.5" ]
verdict "a breakpoint ends the run when an agent enters a state, and says why" $?
[ "$(apart --break 'pupils enters Lesson' | grep -c 'went from Walk')" = 3 ]; verdict "  of a group, all who do so in the step" $?
[ "$(apart --break 'pupils enters Walk' | grep -c 'came in, into Walk')" = 6 ]; verdict "  also those who come in" $?
expect "a breakpoint that is not met is told, with a status" 1 "breakpoint 'anybody enters Hide' was not met in 30 s" "$JOSTLE" run "$school" --set groups.pupils.behaviour=apart.lua --quiet --break 'anybody enters Hide'
expect "  of an agent that never came" 1 "breakpoint 'agent 999 enters Hide' was not met in 30 s: agent 999 never came in, the last who did is agent 6" "$JOSTLE" run "$school" --set groups.pupils.behaviour=apart.lua --quiet --break 'agent 999 enters Hide'
expect "  of one whose behaviour has no such state" 1 "the behaviour pupil of agent 0 has no such state" "$JOSTLE" run "$school" --set groups.pupils.behaviour=apart.lua --quiet --break 'agent 0 enters Stand'
expect "  of one that waits" 1 "agent 1 is in Lesson; \`jostle why SCENE --agent 1 --to Hide\` says more" "$JOSTLE" run "$school" --set groups.pupils.behaviour=apart.lua --quiet --break 'agent 1 enters Hide'
(cd "$work" && "$OLDPWD/$JOSTLE" run school/school.yaml --break 'agent 0 leaves Walk' --checkpoint-dir broken --quiet 2>&1) | grep -q "the state at 6.05 s is in broken"
verdict "  and leaves a checkpoint" $?
expect "    to look at" 0 "6.05 s: agent 0 of group pupils (machine pupil) has been in state Lesson" "$JOSTLE" why --from "$work/broken" --agent 0
same_hash "    to go on from" "$(hash_of "$JOSTLE" "$school")" "$(cd "$work" && "$OLDPWD/$JOSTLE" resume broken --quiet --summary - 2>/dev/null | figure hash)"
expect "  with bodies too, a little later" 0 "the state at" bash -c "cd '$work' && '$PWD/$JOSTLE' run dodgeball --break 'agent 1 enters Attack' --checkpoint-dir thrown --quiet"
expect "a breakpoint that is none is refused" 2 "breakpoint 'stop' is none: it says who does what, as 'agent 17 enters Hide'" "$JOSTLE" run "$school" --break stop
expect "  a state that is not there, with the nearest one" 2 "there is no state 'Hid'. Did you mean 'Hide'?" "$JOSTLE" run "$school" --break 'agent 1 enters Hid'
expect "  a group" 2 "there is no group or agent 'pupil'. Did you mean 'pupils'?" "$JOSTLE" run "$school" --break 'pupil enters Hide'
expect "  a folder for checkpoints without them" 2 "--checkpoint-dir goes with --checkpoint, or with --break" "$JOSTLE" run "$school" --checkpoint-dir "$work/x"
# Machines in states: an outer state is entered and left as one, and its transitions are named once.
cat >"$work/school/guard.lua" <<'END'
local walk = machine { start = "Go", states = { Go = { steer = hold, { to = "Look", when = after(1) } }, Look = { steer = hold, { to = "Go", when = after(1) } } } }
return machine { name = "guard", start = "Wait", states = { Wait = { steer = hold, { to = "Guard", when = after(2) } },
  Guard = { runs = walk, { to = "Wait", when = after(9) }, { to = "Rest", when = now.x:above(99) } }, Rest = { steer = hold } } }
END
guard() { "$JOSTLE" run "$school" --set groups.pupils.behaviour=guard.lua "$@" 2>&1 | tr '\n' ' '; }
guard --break 'agent 0 enters Guard' --quiet | grep -q "t = 2.05 s: breakpoint 'agent 0 enters Guard': agent 0 went from Wait to Guard.Go"
verdict "a breakpoint on an outer state is met when that is entered" $?
guard --break 'agent 0 leaves Guard' --quiet | grep -q "agent 0 went from Guard.* to Wait, when after(9)"; verdict "  and left" $?
guard --break 'agent 0 enters Guard.Look' --quiet | grep -q "t = 3.0.* went from Guard.Go to Guard.Look"; verdict "  and on a state within it" $?
guard | grep -qF "Never fired, though people were in the state and left it: Guard -> Rest."; verdict "a transition of an outer state that never fired is named once" $?
# Reactions are no changes of state: neither a cycle nor a transition of the summary; a step that waits for ever is named.
cat >"$work/school/react.lua" <<'LUA'
local mine = memory { n = 0 }
return machine { name = "react", start = "Walk", states = {
  Walk = { steer = hold, { every = 0.05, set = { n = mine.n + 1 } }, { when = mine.n:above(9999), set = { n = 0 } }, { to = "Rest", when = now.x:above(0.5) } },
  Rest = { runs = sequence { wait(1), { steer = hold, when = now.x:above(500) }, wait(2) }, { to = "Walk", when = done }, { to = "Walk", when = now.y:above(900) } } } }
LUA
react() { "$JOSTLE" run "$school" --set groups.pupils.behaviour=react.lua "$@" 2>&1 | tr '\n' ' '; }
react >"$work/out"; grep -qF "a reaction of state 'Walk' was never done in 30 s, though somebody was always in 'Walk'" "$work/out"; verdict "a reaction that was never done is called one" $?
! grep -q "went round\|from 'Walk' to 'Walk'" "$work/out"; verdict "  and those that are done make no cycle" $?
react --quiet --summary - | grep -q 'Walk>Walk'; [ $? = 1 ]; verdict "  nor a transition of the summary" $?
grep -qF 'Nobody left Rest.2 hold (where the sequence waits, 3 people in it, since 1 s): `jostle why SCENE --state "Rest.2 hold"`' "$work/out"; verdict "a step in which a sequence waits for ever is named" $?
grep -qF 'Rest -> Walk (line 4), Rest -> Walk (line 4)' "$work/out"; verdict "  transitions to one state are told apart by their lines" $?
# A trace counts repetitions, and explains a transition by the values before the reactions of its step.
cat >"$work/school/flip.lua" <<'LUA'
local mine = memory { flip = 0 }
return machine { name = "flip", start = "Walk", states = {
  Walk = { steer = hold, { every = 0.05, set = { flip = 1 - mine.flip } }, { to = "Rest", when = mine.flip:is(1) & after(20) } }, Rest = { steer = hold } } }
LUA
"$JOSTLE" run "$school" --set groups.pupils.behaviour=flip.lua --trace 0 --quiet >"$work/out" 2>&1
[ "$(grep -c '^t=.* in Walk, reaction' "$work/out")" = 6 ] && grep -q "reaction (.*flip.lua:3) again, 160 times since t=7.10" "$work/out"; verdict "a trace counts a reaction that is repeated" $?
[ "$(grep -c 'for Rest: mine.flip is 1 ' "$work/out")" = 5 ] && grep -q 'mine.flip is 1 .* (the last of 161 changes)' "$work/out"; verdict "  and a term that flips" $?
! grep -q 'every(0.05) n' "$work/out"; verdict "  without the beats of every" $?
grep -q 'when mine.flip 1 is 1 and after(20) is true' "$work/out"; verdict "  and shows the values by which a transition was taken" $?
# A trace tells who told a message, what an item that is taken sets and whom it tells, and spells negations as `why` does.
cat >"$work/school/talk.lua" <<'LUA'
local mine = memory { mate = nobody, n = 0 }
local pass = told "pass"
return machine { name = "talk", start = "Wait", defaults = { perception = 9 }, states = {
  Wait = { steer = hold, { when = now.x:below(0.5) & after(1), set = { n = mine.n + 1 } },
    { to = "Got", when = pass, set = { mate = pass.sender }, tell = { pass.sender, "thanks" } },
    { to = "Gave", when = after(2) & now.x:above(0.5), tell = { nearest "anyone", "pass" }, signal = "gave" } },
  Got = { steer = hold, { to = "Wait", when = ~exists(mine.mate) | ~told "more" & after(1), set = { n = 0 } } },
  Gave = { steer = hold, { when = told "thanks", tell = { neighbours "opponents", "well" } }, { to = "Gave", when = told "well" } } } }
LUA
cat >"$work/school/talk.yaml" <<'END'
jostle: 1
duration: 6
groups: {n: {behaviour: talk.lua, at: [[0, 0], [1, 0]]}}
END
"$JOSTLE" run "$work/school/talk.yaml" --trace 0 --quiet >"$work/out" 2>&1
grep -qF '    sets n = 1' "$work/out"; verdict "a trace tells what a reaction sets" $?
grep -qF '    when told("pass") is true (by agent 1 at 2.00 s)' "$work/out"; verdict "  who told a message, and when" $?
grep -qF "    sets mate = agent 1, tells agent 1 'thanks'" "$work/out"; verdict "  what a transition sets, and whom it tells" $?
grep -qF '    when not exists(mine.mate) is false or not told("more") is true and after(1) is true' "$work/out"; verdict "  negations of words" $?
"$JOSTLE" run "$work/school/talk.yaml" --trace 1 --quiet >"$work/out" 2>&1
grep -qF "    tells agent 0 'pass', calls 'gave'" "$work/out" && grep -qF "    tells nobody 'well'" "$work/out"; verdict "  and that it told nobody" $?
