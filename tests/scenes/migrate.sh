#!/usr/bin/env bash
# What the author of a behaviour renamed is told with its new name wherever others write it: in scenes, in
# behaviours and in patches of mods; and jostle migrate writes it there, and nothing else.
. tests/scenes/lib.sh
JOSTLE=$(realpath "$JOSTLE")

# A behaviour whose author renamed a state, an own value and a memory; one who looks at its people; a scene; a mod.
mkdir -p "$work/was/behaviours" "$work/was/scenes/mods/bold/patches"
cat >"$work/was/behaviours/lib.lua" <<'LUA'
local mine = memory { laps_done = 0 }
return machine { name = "lib", version = 2, start = "Stroll",
  own = { bravery = uniform(0, 1) }, public = { "laps_done" },
  renamed = { Amble = "Stroll", courage = "bravery", laps = "laps_done" },
  states = {
    Stroll = { steer = hold, speed = own.bravery, { to = "Gone", when = mine.laps_done:above(3) } },
    Gone = { removes = true },
  } }
LUA
cat >"$work/was/behaviours/other.lua" <<'LUA'
-- held, Amble and laps in comments stay
local busy = nearest("people"):in_state("Amble"):where('laps', 2)
local grasped = held:above(1) | now.held:above(2) | held:above(3)
local text = "held"
return machine { name = "other", version = 1, start = "A",
  states = {
    A = { steer = hold, signal = text, { to = "B", when = near(busy, 2) | grasped },
      { to = "B", id = "far", when = theirs(nearest "people", "laps"):above(2) } },
    B = { removes = true } } }
LUA
# With a mark of UTF-8, ends of lines of another system, a tab behind a value, an anchor with its merge, and quotes.
{
    printf '\357\273\277jostle: 1\r\n# width_eager: a comment\r\nwalking: {"width_eager": 0.2}\t# width_eager\r\n'
    printf 'places:\r\n  h\303\266he yard: {polygon: [[0, 0], [10, 0], [10, 10], [0, 10]]}\r\ngroups:\r\n'
    printf "  people: &p {tags: [people], in: h\303\266he yard, set: {'courage': 0.5}, count: 3, behaviour: lib.lua, memory: {laps: 2}}\r\n"
    printf '  more:\r\n    <<: *p\r\n    count: 2\r\n  others: {behaviour: other.lua, count: 2, in: h\303\266he yard}\r\n'
    printf 'tally:\r\n  laps: {memory: laps, unit: laps}\r\n  amblers: {state: Amble}\r\n'
} >"$work/was/scenes/yard.yaml"
printf 'name: bold\nversion: 1.0.0\napi: 1\n' >"$work/was/scenes/mods/bold/mod.yaml"
cat >"$work/was/scenes/mods/bold/patches/lib.lua" <<'LUA'
return patch "lib" {
  own = { courage = 0.9 },
  states = {
    Amble = { change = { Gone = { chance = 0.5 } }, perception = 5 + own.courage },
    Gone = { append = { { to = "Amble", when = after(9), id = "Amble" } } },
  },
}
LUA
cp -a "$work/was" "$work/tree"
cd "$work/tree" || exit 1

expect "each is told where it is written, with its new name" 1 "names to be renamed" "$JOSTLE" migrate --check scenes behaviours
cp "$work/out" "$work/told"
told() { grep -qF "$2" "$work/told"; verdict "  $1" $?; } # NAME LINE
told "a key of a scene" "scenes/yard.yaml:3:11: 'width_eager' becomes 'room_eager'"
told "a word of behaviours" "behaviours/other.lua:3:17: 'held' becomes 'holders'"
told "  behind now." "behaviours/other.lua:3:37: 'held' becomes 'holders'"
diff -r "$work/was" "$work/tree"; verdict "  and no file is changed" $?
expect "jostle migrate writes all of them" 0 "names renamed" "$JOSTLE" migrate scenes behaviours
cp "$work/out" "$work/told"
told "a state of others" "behaviours/other.lua:2:41: 'Amble' is now 'Stroll'"
told "memory of others, of a condition" "behaviours/other.lua:2:57: 'laps' is now 'laps_done'"
told "  and theirs" "'laps' is now 'laps_done'"
told "an own value that a mod sets" "scenes/mods/bold/patches/lib.lua:2:11: 'courage' is now 'bravery'"
told "  and uses" "scenes/mods/bold/patches/lib.lua:4:75: 'courage' is now 'bravery'"
told "a state that a mod changes" "scenes/mods/bold/patches/lib.lua:4:5: 'Amble' is now 'Stroll'"
told "where a mod's transition leads" "scenes/mods/bold/patches/lib.lua:5:32: 'Amble' is now 'Stroll'"
told "the state of a tally" "scenes/yard.yaml:14:20: 'Amble' is now 'Stroll'"
sed -e '3s/"width_eager"/"room_eager"/' -e "s/'courage'/'bravery'/; s/{laps:/{laps_done:/; s/memory: laps/memory: laps_done/; s/Amble/Stroll/" "$work/was/scenes/yard.yaml" | cmp - scenes/yard.yaml; verdict "of a scene these names alone, each other byte as it was" $?
sed -e '2s/"Amble"/"Stroll"/; 2s/laps/laps_done/; 3s/held/holders/g; 8s/"laps"/"laps_done"/' "$work/was/behaviours/other.lua" | cmp - behaviours/other.lua; verdict "of a behaviour, too: no comment and no other text" $?
sed -e 's/courage/bravery/; s/Amble/Stroll/' "$work/was/scenes/mods/bold/patches/lib.lua" | cmp - scenes/mods/bold/patches/lib.lua; verdict "and of a patch" $?
cmp -s "$work/was/behaviours/lib.lua" behaviours/lib.lua; verdict "what says what was renamed stays" $?
[ -z "$(find . -name '*.part')" ]; verdict "nothing else is left" $?
expect "what was written is right" 0 "nothing wrong" "$JOSTLE" check scenes behaviours
expect "and nothing is left to write" 0 "0 names to be renamed" "$JOSTLE" migrate --check scenes behaviours

BODY='bodies: [{shape: {sphere: {radius: 0.2}}, mass: 1, at: [0, 0, 1]}]\n'
printf 'jostle: 1\nwalking: {"width\\x5feager": 0.2}\n'"$BODY" >escaped.yaml
expect "a name that is written by escapes stays, as an error" 3 "1 error left" "$JOSTLE" migrate escaped.yaml
printf 'jostle: 1\nwalking: &w {width_eager: 0.2}\n'"$BODY" >first.yaml; printf 'include: first.yaml\n' >second.yaml
expect "what several files include is written once, whatever its path is called" 0 "1 name renamed" "$JOSTLE" migrate second.yaml first.yaml ./first.yaml
grep -q '&w {room_eager: 0.2}' first.yaml; verdict "  there" $?

# A new name that needs quotes in Lua is not written where there are none.
sed -i 's/Stroll = {/["Slow walk"] = {/; s/"Stroll"/"Slow walk"/g' behaviours/lib.lua
cp "$work/was/scenes/mods/bold/patches/lib.lua" scenes/mods/bold/patches/lib.lua
expect "a new name that needs quotes is not written where there are none" 3 "1 error left" "$JOSTLE" migrate scenes behaviours
grep -q '^    Amble = {' scenes/mods/bold/patches/lib.lua; verdict "  but left as an error" $?

# While a scene runs.
printf 'jostle: 1\ngroups: {g: {behaviour: behaviours/lib.lua, at: [[0, 0]]}}\n' >one.yaml
log() { printf '%s\n' "$1" >one.input; }
log '5 state 0 Amble'
expect "a line of an input log is told, too: a state" 0 "'Amble' of lib is called 'Slow walk' now" "$JOSTLE" run one.yaml --steps 20 --input one.input
log '5 memory 0 laps 2'
expect "  and memory" 0 "'laps' of lib is called 'laps_done' now" "$JOSTLE" run one.yaml --steps 20 --input one.input
