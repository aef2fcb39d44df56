#!/usr/bin/env bash
# `renamed` names of a behaviour: an old name in another behaviour, a scene, a patch of a mod or an input log is an error
# that gives the new name.
. tests/scenes/lib.sh
JOSTLE=$(realpath "$JOSTLE")

# A behaviour that renamed a state, an own value and a memory; a behaviour that refers to its people; scenes; a mod.
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
local busy = nearest("people"):in_state("Amble"):where('laps', 2)
return machine { name = "other", version = 1, start = "A",
  states = {
    A = { steer = hold, { to = "B", when = near(busy, 2) },
      { to = "B", id = "far", when = theirs(nearest "people", "laps"):above(2) } },
    B = { removes = true } } }
LUA
cat >"$work/was/scenes/yard.yaml" <<'YAML'
jostle: 1
places:
  yard: {polygon: [[0, 0], [10, 0], [10, 10], [0, 10]]}
groups:
  people: {tags: [people], in: yard, set: {courage: 0.5}, count: 3, behaviour: lib.lua, memory: {laps: 2}}
  others: {behaviour: other.lua, count: 2, in: yard}
tally:
  laps: {memory: laps, unit: laps}
  amblers: {state: Amble}
YAML
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
cd "$work/was" || exit 1

told() { grep -qF "$2" "$work/out"; verdict "  $1" $?; } # NAME TEXT
expect "old names are errors" 3 "6 errors" "$JOSTLE" check scenes/yard.yaml
told "an old name of a value in set is an error" "scenes/yard.yaml:5:44: 'courage' is called 'bravery' now. Write the new name"
told "an old name of a group's memory" "scenes/yard.yaml:5:98: 'laps' is called 'laps_done' now"
told "an old name of a state in a condition of another behaviour" "behaviours/other.lua:1:41: 'Amble' is called 'Stroll' now"
told "an old name of memory in a condition of another behaviour" "behaviours/other.lua:1:56: 'laps' is called 'laps_done' now"
told "an old name of memory in a tally" "scenes/yard.yaml:8:18: 'laps' is called 'laps_done' now"
told "an old name of a state in a tally" "scenes/yard.yaml:9:20: 'Amble' is called 'Stroll' now"
sed -i 's/courage:/bravery:/; s/laps:/laps_done:/; s/memory: laps,/memory: laps_done,/; s/Amble/Stroll/' scenes/yard.yaml
sed -i 's/"Amble"/"Stroll"/; s/.laps.)/"laps_done")/; s/.laps., 2/"laps_done", 2/' behaviours/other.lua
patched() { "$JOSTLE" run scenes/yard.yaml --mod bold --steps 2 --quiet >"$work/out" 2>&1; }
patched; told "an old name of a state in a patch" "patches/lib.lua:4:5: 'Amble' is called 'Stroll' now"
sed -i 's/Amble = {/Stroll = {/; s/"Amble"/"Stroll"/' scenes/mods/bold/patches/lib.lua
patched; told "an old name of an own value in a patch" "patches/lib.lua:4:75: 'courage' is called 'bravery' now"
sed -i 's/own.courage/own.bravery/' scenes/mods/bold/patches/lib.lua
patched; told "  also where the patch sets it" "patches/lib.lua:2:11: 'courage' is called 'bravery' now"
sed -i 's/courage/bravery/' scenes/mods/bold/patches/lib.lua
patched; verdict "  with the new names the mod is loaded" $?
expect "with the new names everything loads" 0 "nothing wrong" "$JOSTLE" check scenes behaviours

# While a scene runs.
printf 'jostle: 1\ngroups: {g: {behaviour: behaviours/lib.lua, at: [[0, 0]]}}\n' >one.yaml
log() { printf '%s\n' "$1" >one.input; }
log '5 state 0 Amble'
expect "an old name of a state in an input log is an error" 0 "'Amble' of lib is called 'Stroll' now" "$JOSTLE" run one.yaml --steps 20 --input one.input
log '5 memory 0 laps 2'
expect "  also of memory" 0 "'laps' of lib is called 'laps_done' now" "$JOSTLE" run one.yaml --steps 20 --input one.input
