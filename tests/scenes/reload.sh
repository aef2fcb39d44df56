# Reloads of files that are edited during a run, in the ways in which editors save: each valid save replaces the running
# version, an invalid one does not, and files that depend on each other change together or not at all.
. tests/scenes/lib.sh
SLOWER=${SLOWER:-1} # factor by which a build is slower (sanitisers)
dir=$work/scenes
mkdir -p "$dir" "$work/behaviours" "$work/other"
pid=

begin() { # ARGS...: runs $dir/scene.yaml until `end`; its output goes to $said
    said=$work/said
    : >"$said"
    nice "$JOSTLE" run "$dir/scene.yaml" --steps 900000000 --watch --quiet --no-mods "$@" >"$said" 2>&1 </dev/null &
    pid=$!
    for i in $(seq 200); do # until the thread that watches files has started
        [ "$(ls /proc/$pid/task 2>/dev/null | wc -l)" -lt 2 ] || break
        sleep 0.05
    done
}
end() { # NAME: interrupts the run, and checks its status
    kill -INT $pid
    wait $pid; [ $? = 130 ]; verdict "$1" $?
    pid=
}
trap '[ -z "$pid" ] || kill -KILL $pid; rm -rf "$work"' EXIT
count() { grep -cF -- "$1" "$said"; }
# says TEXT [TIMES]: waits up to a few seconds until the run has printed a text so many times
says() {
    local wanted=${2:-1}
    for i in $(seq $((250 * SLOWER))); do
        [ "$(count "$1")" -lt "$wanted" ] || return 0
        sleep 0.02
    done
    return 1
}
expect() { # NAME TEXT [TIMES]: checks that
    if says "$2" "${3:-1}"; then echo "ok $1"; else
        echo "not ok $1: did not say '$2'"; tail -12 "$said"; fi
}
quiet() { # NAME LINES: checks that the run has printed only so many lines
    sleep 0.3
    if [ "$(wc -l <"$said")" = "$2" ]; then echo "ok $1"; else
        echo "not ok $1"; tail -n +$(($2 + 1)) "$said" | head; fi
}
sheet() { # SPEED [MORE]: prints a behaviour of one state
    printf 'return machine { name = "walker", version = 1, start = "Walk",\n'
    printf '  defaults = { speed = %s },\n' "$1"
    printf '  states = { Walk = { steer = hold }%s } }\n' "${2:-}"
}
scene() { # GROUPS [MORE]
    printf 'jostle: 1\nplaces: {yard: {polygon: [[0, 0], [20, 0], [20, 20], [0, 20]]}}\n%s\ngroups:\n' "${2:-}"
    local name
    for name in $1; do
        printf '  %s: {behaviour: ../behaviours/%s.lua, count: 20, fill: grid, in: yard}\n' "$name" "$name"
    done
}

# ---- the ways in which editors save; the new text comes on stdin ----
save_vim() { : >"$(dirname "$1")/4913"; rm "$(dirname "$1")/4913"; mv "$1" "$1~"; cat >"$1"; rm "$1~"; }
save_code() { cat >"$work/new"; truncate -s 0 "$1"; cat "$work/new" >>"$1"; }
save_sed() { cat >/dev/null; sed -i "s/speed = [0-9.]*/speed = $2/" "$1"; }
save_cat() { cat >"$1"; }
save_mv() { cat >"$work/other/new"; mv "$work/other/new" "$1"; }
save_emacs() { cat >"$(dirname "$1")/.#new"; cp "$1" "$1~"; mv "$(dirname "$1")/.#new" "$1"; }
save_pause() { cat >"$work/new"; { head -c 60 "$work/new"; sleep 0.06; tail -c +61 "$work/new"; } >"$1"; }
save_chunks() { cat >"$work/new"; head -c 60 "$work/new" >"$1"; sleep 0.06; tail -c +61 "$work/new" >>"$1"; }

file=$work/behaviours/walker.lua
sheet 1 >"$file"; scene walker >"$dir/scene.yaml"
begin
version=1 edits=0
live() { # HOW SPEED: saves a valid behaviour; false if it does not replace the running one
    sheet "$2" | "save_$1" "$file" "$2"
    version=$((version + 1)) edits=$((edits + 1))
    says "version 1 (reload $((version - 1))) is live"
}
# 100 edits, every tenth invalid
bad=""
for round in $(seq 12); do
    for how in vim code sed cat mv emacs pause chunks; do
        live $how 1.$((round + 10))$((edits % 10)) || { bad="$bad $how:$version"; version=$((version - 1)); }
    done
    refused=$(count 'keeps running')
    how=$(echo vim code cat mv emacs pause | cut -d' ' -f$((round % 6 + 1)))
    sheet 1.5 | sed 's/steer/stear/' | "save_$how" "$file" 1.5
    edits=$((edits + 1))
    says "Did you mean 'steer'?" $round && says "Version 1 (reload $((version - 1))) keeps running" || bad="$bad broken:$how"
    [ "$(count 'keeps running')" -gt "$refused" ] || bad="$bad silent:$how"
done
[ -z "$bad" ]; verdict "$edits edits in the ways of editors go live$bad" $?
expect "a message gives the number of people per state before and after" "before:  Walk 20"
live cat 1.9; verdict "a corrected file goes live" $?
lines=$(wc -l <"$said")
sheet 1.9 >"$file"; sheet 1.9 | save_vim "$file"; touch "$file"; sheet 1.9 | save_mv "$file"
quiet "what is saved without a change is left alone" "$lines"
rm "$file"; sleep 0.1; sheet 1.95 >"$file"; version=$((version + 1))
expect "a file that was removed for a while is reloaded" "version 1 (reload $((version - 1))) is live"
: >"$work/behaviours/stop"
( while [ -e "$work/behaviours/stop" ]; do : >"$work/behaviours/walker.log"; sleep 0.002; done ) &
noise=$!
sleep 0.1; live cat 1.7; verdict "a reload works in a folder in which files are written all the time" $?
rm "$work/behaviours/stop"; wait $noise
lines=$(wc -l <"$said")
sheet 1.3 >"$work/behaviours/.walker.lua.swp"; sheet 1.3 >"$file~"; sheet 1.3 >"$work/behaviours/walker.lua.bak"
quiet "backups and swap files are not looked at" "$lines"
rm -f "$file~"
sheet 1.4 ', Later = { steer = hold }' >"$file"; says "version 1 (reload $version) is live"
sed -i 's/start = "Walk"/start = "Later"/; s/Walk = /Stroll = /' "$file"
expect "a version without a state that people are in is refused" "20 agents are in 'Walk', which this version lacks"
sed -i 's/start = "Later",/start = "Later", renamed = { Walk = "Stroll" },/' "$file"
expect "people keep a renamed state" "after:   Stroll 20"
version=$((version + 2))
sed -i 's/version = 1,/version = 10,/' "$file"
expect "a message gives the file's version and the count of reloads" "walker.lua: version 10 (reload $version) is live"
sed -i 's/start = "Later"/start = "Late"/' "$file"
expect "a message gives the version that keeps running" "Version 10 (reload $version) keeps running"
sed -i 's/version = 10, //; s/start = "Late"/start = "Later"/' "$file"
expect "a file without a version is named by the count alone" "walker.lua: reload $((version + 1)) is live"
end "a run that was edited ends well"

# ---- files that are required ----
lib=$work/behaviours/pace.lua
user() { printf 'local pace = require "pace"\n'; sheet "$1"| sed 's/hold/hold, speed = pace.slow/'; }
pace() { printf 'local pace = {}\npace.slow = own.speed * %s\nreturn pace\n' "$1"; }
rm -f "$work"/behaviours/*
pace 0.5 >"$lib"; user 1 >"$work/behaviours/a.lua"; user 1 >"$work/behaviours/b.lua"; sheet 1 >"$work/behaviours/c.lua"
scene "a b c" >"$dir/scene.yaml"
begin
pace 0.6 | save_vim "$lib"
says "a.lua: version 1 (reload 1) is live" && says "b.lua: version 1 (reload 1) is live"; verdict "all files that require a changed file are reloaded" $?
echo 'local pace = {' >"$lib"
says "pace.lua:" && says "Version 1 (reload 1) of walker keeps running" 2; verdict "a broken required file leaves the old versions running" $?
pace 0.7 >"$lib"
says "a.lua: version 1 (reload 2) is live" && says "b.lua: version 1 (reload 2) is live"; verdict "a corrected required file is reloaded" $?
[ "$(count 'c.lua: version')" = 0 ]; verdict "files that do not require it are not reloaded" $?

# If one of two files cannot be loaded, neither is, until it is corrected.
sheet 1.5 >"$work/behaviours/c.lua"; user 2 >"$work/behaviours/b.lua"; pace 0.75 >"$lib"; echo 'return machine {' >"$work/behaviours/a.lua"
says "Version 1 (reload 2) of walker keeps running" 2 && [ "$(count 'b.lua: version 1 (reload 3)')" = 0 ]; verdict "good files that depend on a broken one wait for it" $?
expect "an independent file goes live meanwhile" "c.lua: version 1 (reload 1) is live"
user 2 >"$work/behaviours/a.lua"
says "a.lua: version 1 (reload 3) is live" && says "b.lua: version 1 (reload 3) is live"; verdict "they go live when it is corrected" $?
pace 0.8 >"$lib"; sed -i 's/Walk/Run/g' "$work/behaviours/b.lua"
says "20 agents are in 'Walk'" && [ "$(count 'a.lua: version 1 (reload 4)')" = 0 ]; verdict "one of two files is refused for the state of its people" $?
sed -i 's/start = "Run"/start = "Run", renamed = { Walk = "Run" }/' "$work/behaviours/b.lua"
says "b.lua: version 1 (reload 4) is live" && says "a.lua: version 1 (reload 4) is live"; verdict "both go live when it renames that state" $?

# Requiring a file that does not exist yet.
sed -i 's/require "pace"/require "gait"/' "$work/behaviours/a.lua"
expect "a missing required file is an error" "cannot require 'gait'"
pace 0.9 >"$work/behaviours/gait.lua"
expect "a required file that is written later is loaded" "a.lua: version 1 (reload 5) is live"
pace 0.4 >"$work/behaviours/gait.lua"
expect "it is watched from then on" "a.lua: version 1 (reload 6) is live"
sed -i 's/require "gait"/require "gaits\/slow"/' "$work/behaviours/a.lua"
expect "a required file in a missing folder is an error" "cannot require 'gaits/slow'"
mkdir "$work/behaviours/gaits"; sleep 0.1; pace 0.9 >"$work/behaviours/gaits/slow.lua"
expect "a folder that is made later is read" "a.lua: version 1 (reload 7) is live"
mv "$work/behaviours/gaits" "$work/other/gaits"; sleep 0.05
mkdir "$work/behaviours/gaits"; pace 0.2 >"$work/behaviours/gaits/slow.lua"
expect "a folder that is replaced by another one is read" "a.lua: version 1 (reload 8) is live"
rm -r "$work/behaviours/gaits"; sleep 0.05
mkdir "$work/behaviours/gaits"; pace 0.1 >"$work/behaviours/gaits/slow.lua"
expect "a folder that is removed and made again is read" "a.lua: version 1 (reload 9) is live"
lines=$(wc -l <"$said")
pace 0.3 >"$work/behaviours/gait.lua"
quiet "what is no longer required is left alone" "$lines"

# A behaviour that others become, by an edit.
printf 'print("hello from c")\nreturn machine { name = "walker", start = "Walk",\n states = { Walk = { steer = hold, { to = "Leave", when = after(0.2) } },\n  Leave = { become = "d" } } }\n' >"$work/behaviours/c.lua"
expect "a behaviour that becomes a missing one is refused" "there is no behaviour 'd'"
sheet 1 >"$work/behaviours/d.lua"
expect "a required file that is written later is loaded" "c.lua: reload 2 is live"
grep -q 'hello from c' "$said"; verdict "the output of a loading file is printed" $?
sheet 0.5 >"$work/behaviours/d.lua"
says "d.lua: version 1 (reload 1) is live" && says "before:  Walk 20" ; verdict "the machine that agents become is watched" $?
end "a run whose files require each other ends well"

# ---- mods ----
mkdir -p "$work/slow/patches"
printf 'name: slow\ntitle: Slow\nversion: 1.0.0\napi: 1\n' >"$work/slow/mod.yaml"
patch() { printf 'return patch "walker" { states = { Walk = { push = %s } } }\n' "$1"; }
patch 20 >"$work/slow/patches/walker.lua"
sheet 1 >"$file"; scene walker >"$dir/scene.yaml"
begin --mod "$work/slow"
patch 30 | save_vim "$work/slow/patches/walker.lua"
expect "a patch of a mod goes live" "walker.lua: version 1 (reload 1) is live"
patch '"x"' >"$work/slow/patches/walker.lua"
expect "a wrong patch leaves the old version running" "Version 1 (reload 1) keeps running"
sed 's/title: Slow/title: Slower/' "$work/slow/mod.yaml" | save_vim "$work/slow/mod.yaml"
expect "an edited mod.yaml is reported" "slow/mod.yaml changed; what it says of the mod, as of its settings, takes effect at the next start"
patch 35 >"$work/slow/patches/walker.lua"
expect "a corrected patch goes live" "walker.lua: version 1 (reload 2) is live"
echo 'settings: {weight: {value: 2}}' >>"$work/slow/mod.yaml"
expect "a second edit of mod.yaml is reported" "slow/mod.yaml changed; what it says" 2
[ "$(count 'slow/mod.yaml changed')" = 2 ]; verdict "each edit is reported once" $?
patch 40 >"$work/slow/patches/second.lua"
expect "an added patch is reported" "slow/patches/ has other files; which patches a mod has takes effect at the next start"
mv "$work/slow/patches/second.lua" "$work/slow/patches/second.off"
expect "a removed patch is reported" "slow/patches/ has other files" 2
end "a run with a mod ends well"

# ---- the scene's own file ----
scene walker "include: more.yaml" >"$dir/scene.yaml"
gate() { printf 'places: {gate: {point: [%s, 5]}}\n' "$1"; }
gate 3 >"$dir/more.yaml"
begin
gate 4 | save_vim "$dir/more.yaml"
expect "a place moved in an included file goes live" "places changed, live from"
sed -i 's/20, 20\], \[0/22, 20], [0/' "$dir/scene.yaml"
expect "a place moved in the scene goes live" "places changed, live from" 2
echo 'seed: 5' >>"$dir/scene.yaml"
expect "a key that cannot change during a run is reported" "seed (all random numbers follow from it): takes effect at the next start"
echo 'seeed: 5' >>"$dir/scene.yaml"
expect "a broken scene leaves the run as it was" "The scene goes on as it was"
sed -i '/seeed/d; s/behaviour: /set: {speed: 0.4}, behaviour: /' "$dir/scene.yaml"
expect "a value set by a group goes live" "values that groups set changed"
printf 'walls:\n  - {solid: [[10, 10], [12, 10], [12, 12], [10, 12]]}\n' >>"$dir/scene.yaml"
expect "an added wall goes live" "walls changed, live"
expect "changed starts take effect at the next start" "where people start, by the edited walls and places: takes effect at the next start" 2
[ "$(count 'of groups')" = 0 ]; verdict "groups that were not edited are not mentioned" $?
cp "$dir/scene.yaml" "$work/kept.yaml"
sed -i 's/^\(  [a-z]*\)\(: {.*behaviour: .*\)/\1\2\n\1more\2/' "$dir/scene.yaml"
expect "renamed groups take effect at the next start" "groups (other names or order): takes effect at the next start"
gate 7 >"$dir/more.yaml"
expect "a place moves while other changes wait" "places changed, live from" 3
cp "$work/kept.yaml" "$dir/scene.yaml"; gate 4 >"$dir/more.yaml"
expect "and moves back" "places changed, live from" 4
sheet 1.2 >"$file"
expect "a behaviour is reloaded after the scene" "version 1 (reload 1) is live"
sheet 1.2 ', At = { steer = seek(own.goal) }' >"$file"
expect "a behaviour with a value that the scene does not set is refused" "'goal' is no parameter, and no group that runs walker sets it"
expect "the message quotes its line" "own.goal"
sed -i 's/speed: 0.4/speed: 0.4, goal: gate/' "$dir/scene.yaml"
expect "the scene sets that value" "values that groups set changed" 2
sheet 1.2 ', At = { steer = seek(own.goal), { to = "Gone", when = near(own.goal, 1) } }, Gone = { removes = true }' |
    sed 's/hold/hold, { to = "At", when = after(0) }/' >"$file"
expect "then the behaviour goes live" "version 1 (reload 2) is live"
sleep 0.5; sed -i 's/after(0)/after(0.01)/' "$file"
says "version 1 (reload 3) is live" && ! grep -A1 'version 1 (reload 3) is live' "$said" | grep -q 'before:.* 20$'; verdict "people reach the moved place" $?
end "a run whose scene was edited ends well"
