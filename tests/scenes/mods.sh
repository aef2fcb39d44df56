# Mods: search, order, merging, conflicts, blame, settings, and refusals.
. tests/scenes/lib.sh
program=$(case $JOSTLE in /*) echo "$JOSTLE" ;; *) echo "$PWD/$JOSTLE" ;; esac)
says() { # NAME STATUS TEXT COMMAND...: checks exit status and a text in the output
    local name=$1 status=$2 text=$3; shift 3
    timeout 300 "$@" >"$work/out" 2>&1 </dev/null
    local got=$?
    if [ $got = "$status" ] && grep -qF -- "$text" "$work/out"; then echo "ok $name"; else
        echo "not ok $name: status $got, wanted $status and '$text'"; head -8 "$work/out"; fi
}
also() { grep -qF -- "$2" "$work/out"; verdict "$1" $?; } # NAME TEXT: checks a text in the output of the command before
both=(--mod gentle-queue --mod rough)
says "a mod beside the scenes is found by its name" 0 "1. gentle-queue 1.0.0" "$JOSTLE" mod list scenes/tawaf.yaml --mod gentle-queue
says "mods that were not asked for are not loaded" 0 "off: rough" "$JOSTLE" mod list scenes/tawaf.yaml --mod gentle-queue
says "mods without dependencies are ordered by name" 0 "2. rough" "$JOSTLE" mod list scenes/tawaf.yaml "${both[@]}"
says "a conflict names the winner and its place" 3 "rough/patches/tawaf.lua:3:17: warning: mods gentle-queue and rough both set states.ToStone.push" bash -c "$JOSTLE run scenes/tawaf.yaml --steps 1 --set groups.pilgrims.count=100 --set sources.0.keep=100 --quiet ${both[*]}; exit 3"
says "a conflict also names the other mod and its place" 3 "set before by mod gentle-queue at scenes/mods/gentle-queue/patches/tawaf.lua:14; mod rough comes later and wins" bash -c "$JOSTLE run scenes/tawaf.yaml --steps 1 --set groups.pilgrims.count=100 --set sources.0.keep=100 --quiet ${both[*]}; exit 3"
says "why: the behaviour's own line" 0 ":87: shove" "$JOSTLE" mod why tawaf.ToStone.push scenes/tawaf.yaml "${both[@]}"
says "why: the last mod's line" 0 "rough/patches/tawaf.lua:3:17: 60 * max(now.speed, own.speed)   (mod rough 1.0.0)" "$JOSTLE" mod why tawaf.ToStone.push scenes/tawaf.yaml "${both[@]}"
says "why: a value of a scene, set by a mod" 0 "doubles/patches/dodgeball.yaml" "$JOSTLE" mod why groups.red.at scenes/dodgeball.yaml --mod doubles
says "why: a number of a kick, set by a mod" 0 "doubles/patches/dodgeball.lua:9:25: 15   (mod doubles 1.0.0)" "$JOSTLE" mod why dodgeball.Attack.kick.lift scenes/dodgeball.yaml --mod doubles
says "why: the rest of that kick, of the behaviour" 0 "behaviours/dodgeball.lua:" "$JOSTLE" mod why dodgeball.Attack.kick.speed scenes/dodgeball.yaml --mod doubles
says "why: a value of a scene, set by its own file" 0 "scenes/dodgeball.yaml:24:9: [[" "$JOSTLE" mod why groups.red.at scenes/dodgeball.yaml --mod doubles
says "why: a value of a body, by its name" 0 "scenes/dodgeball.yaml:17:11: 0.4" "$JOSTLE" mod why bodies.ball.mass scenes/dodgeball.yaml
says "why: a value of a body, by its number" 0 "the default: 0.6" "$JOSTLE" mod why bodies.0.friction scenes/dodgeball.yaml
says "why: a default in a table that the scene omits" 0 "the default: physical" "$JOSTLE" mod why forces.mode scenes/dodgeball.yaml
says "why: a value set by an included file" 0 "scenes/tawaf.yaml:" "$JOSTLE" mod why step scenes/tawaf-few.yaml
says "why: an unknown key is refused" 3 "neither the scene nor a behaviour or a mod sets 'groups.rad.at'" "$JOSTLE" mod why groups.rad.at scenes/dodgeball.yaml
says "why: a value that nothing sets" 3 "nothing sets" "$JOSTLE" mod why tawaf.Circle.nonsense scenes/tawaf.yaml
says "why: the engine's default" 0 "the default: 0.1 m" "$JOSTLE" mod why tawaf.Circle.push_reach scenes/tawaf.yaml
says "why --agent: the value of an agent in a run" 0 "speed of agent 9 at 3.00 s, in state Work: 1.37993" "$JOSTLE" mod why speed scenes/evacuation.yaml --agent 9 --at 3
also "  with the place that set it" "(defaults)"
says "  memory that the scene sets" 0 "tawaf-few.yaml:6:43: 0   (groups.pilgrims)" "$JOSTLE" mod why laps scenes/tawaf-few.yaml --agent 8 --at 1
says "  an unknown value is refused" 3 "did you mean speed" "$JOSTLE" mod why spede scenes/evacuation.yaml --agent 9
says "  an unknown agent is refused" 3 "there is no agent 9999 at 0.00 s; those who are there have ids from 0 to" "$JOSTLE" mod why speed scenes/evacuation.yaml --agent 9999
says "  an agent that has left is refused" 3 "there is no agent 3 at 100.00 s: it left at " "$JOSTLE" mod why speed scenes/bottleneck.yaml --agent 3 --at 100
also "  with the ids of present agents" " s; nobody is there"
says "  --at without --agent is refused" 2 "--at goes with --agent" "$JOSTLE" mod why speed scenes/evacuation.yaml --at 3
says "an unknown mod" 3 "there is no mod 'gentle-quue'. Did you mean 'gentle-queue'?" "$JOSTLE" run scenes/tawaf.yaml --steps 1 --quiet --set groups.pilgrims.count=10 --set sources.0.keep=10 --mod gentle-quue
says "the mod doubles makes four players and three balls" 0 '"bodies": 3' "$JOSTLE" run scenes/dodgeball.yaml --mod doubles --steps 5 --quiet --summary -
also "  with the right names" '"agents": 4'
says "a mod that was asked for and changes nothing gives a warning" 0 "gentle-queue/patches/tawaf.lua:5:14: warning: mod gentle-queue changes nothing of this scene, which has no 'tawaf'" "$JOSTLE" run scenes/dodgeball.yaml --mod gentle-queue --steps 5 --quiet
"$JOSTLE" run scenes/dodgeball.yaml --mod doubles --steps 5 --quiet 2>&1 | grep -q "changes nothing"; [ $? = 1 ]; verdict "  a mod that changes something gives none" $?
says "without the mod there are two players" 0 '"agents": 2' "$JOSTLE" run scenes/dodgeball.yaml --steps 5 --quiet --summary -
says "reference mods lists functions, with parameters and comments" 0 '| `has_room(place, most)` | function | Whether there is room around a place' "$JOSTLE" reference mods scenes/tawaf.yaml --mod gentle-queue
also "  and values" '| `squeezed` | a condition | Whether the net force'
says "  of loaded mods alone" 0 "No mod is taken" "$JOSTLE" reference mods scenes/tawaf.yaml
says "  and nothing of other pages" 2 "go with 'mods' alone" "$JOSTLE" reference scenes --mod gentle-queue
says "a file that others require is not taken for a behaviour without a machine" 0 "nothing wrong" "$JOSTLE" mod check scenes/mods/gentle-queue
# Effect of a setting: nobody joins the queue with the chance 0, many with 1.
joined() { "$JOSTLE" run scenes/tawaf.yaml --set groups.pilgrims.count=600 --set sources.0.keep=600 --for 120 --quiet --mod gentle-queue \
    --set mods.gentle-queue.chance=$1 --set mods.gentle-queue.crowding=9 --summary - 2>/dev/null | sed -n 's/.*"ToStone": \([0-9]*\).*/\1/p'; }
between "gentle-queue with the chance 0: nobody queues" "$(joined 0)" 0 0
between "gentle-queue with the chance 1: many queue" "$(joined 1)" 3 600
says "a setting out of its range" 3 "setting 'chance' of mod gentle-queue must be from 0 to 1, not 7" "$JOSTLE" run scenes/tawaf.yaml --steps 1 --quiet --set groups.pilgrims.count=10 --set sources.0.keep=10 --mod gentle-queue --set mods.gentle-queue.chance=7
says "an unknown setting is refused" 0 "names no setting of a mod" "$JOSTLE" run scenes/tawaf.yaml --steps 1 --quiet --set groups.pilgrims.count=10 --set sources.0.keep=10 --mod gentle-queue --set mods.gentle-queue.chanse=1

# A project made here.
tree=$work/tree
mkdir -p "$tree/behaviours" "$tree/scenes"
cp behaviours/stander.lua behaviours/walker.lua "$tree/behaviours/"; cp -R scripts "$tree/"
printf 'jostle: 1\nplaces: {goal: {point: [9, 0]}}\ngroups: {g: {behaviour: stander.lua, at: [[0, 0], [2, 0]]}}\n' >"$tree/scenes/yard.yaml"
mod() { # NAME YAML [PATCH-FILE TEXT]
    mkdir -p "$tree/scenes/mods/$1/patches"
    printf 'name: %s\nversion: 1.0\napi: 1\n%s\n' "$1" "$2" >"$tree/scenes/mods/$1/mod.yaml"
    [ -z "$3" ] || printf '%s\n' "$4" >"$tree/scenes/mods/$1/patches/$3"
}
off() { (cd "$tree" && exec "$program" run scenes/yard.yaml --steps 3 --quiet --summary - "$@"); }
on() { for folder in "$tree"/scenes/mods/*/; do "$program" mod enable "$folder" >/dev/null 2>&1; done; } # in their present state
run() { on; off "$@"; }
export -f run on off 2>/dev/null; export tree program
plain=$(run | figure hash)
mod alpha "" stander.lua 'return patch "stander" { defaults = { radius = 0.25 } }'
# A mod in a folder of mods is off until a person turns it on, and again when its files change.
same_hash "a mod that was not turned on is not loaded" "$plain" "$(off 2>/dev/null | figure hash)"
says "it is listed as off" 0 "off: alpha 1.0" "$program" mod list "$tree/scenes/yard.yaml"
says "an unknown mod cannot be turned on" 3 "there is no mod 'alpa' here. Did you mean 'alpha'?" "$program" mod enable alpa "$tree/scenes/yard.yaml"
says "mod enable turns a mod on by its name" 0 "mod alpha is on" bash -c 'cd "$tree" && "$program" mod enable alpha'
says "an enabled mod is loaded, and a message says so" 0 "mods: alpha 1.0" bash -c off
says "it is listed as on" 0 "scenes/mods/alpha; on)" "$program" mod list "$tree/scenes/yard.yaml"
cp -R "$tree/scenes/mods/alpha" "$work/alpha"; echo "-- more" >>"$tree/scenes/mods/alpha/patches/stander.lua"
says "a mod whose files change is off, and a message says so" 0 "warning: mod alpha has changed since it was turned on: it is off" bash -c off
same_hash "  it is not loaded" "$plain" "$(off 2>/dev/null | figure hash)"
says "  and listed as changed" 0 "off, as it has changed since it was turned on: alpha 1.0" "$program" mod list "$tree/scenes/yard.yaml"
says "--mod loads it for one run" 0 '"mods": ["alpha 1.0"]' bash -c "off --mod alpha"
same_hash "  and not for the next" "$plain" "$(off 2>/dev/null | figure hash)"
rm -r "$tree/scenes/mods/alpha"; mv "$work/alpha" "$tree/scenes/mods/alpha"
says "with its former files the mod is on again" 0 '"mods": ["alpha 1.0"]' bash -c off
echo x >"$tree/scenes/mods/alpha/patches/note.txt"
says "an added file is a change too" 0 '"mods": []' bash -c off
rm "$tree/scenes/mods/alpha/patches/note.txt"
says "mod disable turns it off" 0 "alpha is off" "$program" mod disable "$tree/scenes/mods/alpha"
same_hash "  and it is no longer loaded" "$plain" "$(off 2>/dev/null | figure hash)"
echo "enabled: true" >>"$tree/scenes/mods/alpha/mod.yaml"
says "a scene cannot turn a mod on" 3 "alpha/mod.yaml:5:10: 'enabled' is no key of a mod: none turns itself on" "$program" mod check "$tree/scenes/mods/alpha"
rm -r "$tree/scenes/mods/alpha"
mod alpha "" stander.lua 'return patch "stander" { defaults = { radius = 0.25 } }'
mkdir -p "$tree/scenes/mods/alpha/behaviours"
printf -- '-- Walks on.\nreturn machine { name = "onward", version = 1, start = "Go", states = { Go = { steer = drift(1, 0) } } }\n' >"$tree/scenes/mods/alpha/behaviours/onward.lua"
printf -- 'return { -- no comment\n  -- Twice\n  -- as far.\n  far = function(n) return 2 * n end,\n  broad = 3 }\n' >"$tree/scenes/mods/alpha/behaviours/reach.lua"
says "reference mods lists a behaviour" 0 "### behaviour: alpha:onward" "$program" reference mods "$tree/scenes/yard.yaml" --mod alpha
also "  a function in a table, with a comment of several lines" '| `far(n)` | function | Twice as far. |'
also "  a number without a comment" '| `broad` | number |  |'
echo 'return {' >"$tree/scenes/mods/alpha/behaviours/reach.lua"
says "  a file that does not load, with its line" 0 "alpha/behaviours/reach.lua:2" "$program" reference mods "$tree/scenes/yard.yaml" --mod alpha
rm -r "$tree/scenes/mods/alpha/behaviours"
mod omega "depends: [alpha]"
says "dependencies of a mod must be on or named, too" 3 "omega/mod.yaml:4:11: mod omega needs mod alpha, which is off. Turn it on: jostle mod enable" bash -c "off --mod omega"
says "  as this one is" 0 '"mods": ["alpha 1.0", "omega 1.0"]' bash -c "off --mod omega --mod alpha"
rm -r "$tree/scenes/mods/omega"
says "all enabled mods are loaded, and named" 0 "mods: alpha 1.0" bash -c run
[ "$plain" != "$(run 2>/dev/null | figure hash)" ]; verdict "enabled mods change the hash" $?
same_hash "--no-mods loads none" "$plain" "$(run --no-mods | figure hash)"
mod beta "depends: [alpha]" stander.lua 'return patch "stander" { states = { Stand = { psh = 3 } } }'
mod gamma "depends: [beta]" stander.lua 'return patch "stander" { states = { Stand = { push = 3 } } }'
says "a failing mod is named with its place" 0 "scenes/mods/beta/patches/stander.lua:1:47: unknown key 'psh'. Did you mean 'push'?" bash -c run
says "a failing mod is left out with the mods that need it, and the run goes on" 0 "mod beta is left out, and gamma, which needs it" bash -c run
grep -q '"mods": \["alpha 1.0"\]' "$work/out"; verdict "the other mods stay" $?
says "a mod that is asked for must load" 3 "mod 'beta' was asked for and cannot be taken" bash -c "run --mod beta"
says "  also if asked for by its folder" 3 "mod 'scenes/mods/gamma/' was asked for and cannot be taken" bash -c "run --mod scenes/mods/gamma/"
says "  and another one is loaded" 0 "mods: alpha 1.0" bash -c "run --no-mods --mod scenes/mods/alpha/"
rm -r "$tree/scenes/mods/beta"
says "a missing dependency is an error" 0 "gamma/mod.yaml:4:11: there is no mod 'beta', which is needed by gamma" bash -c run
mod beta "depends: [gamma]"
says "a circle of dependencies is an error" 0 "depend on each other" bash -c run
rm -r "$tree/scenes/mods/beta" "$tree/scenes/mods/gamma"
mod later "depends: ['alpha >= 2.1']"
says "a dependency of too old a version is an error" 0 "mod later needs alpha 2.1 or later; 1.0 is there" bash -c run
mod later "conflicts: alpha"
says "mods in conflict are an error" 0 "mod later does not go together with alpha" bash -c run
mod later "load_after: [zeta]" stander.lua 'return patch "stander" { defaults = { radius = 0.3 } }'
mod zeta "" stander.lua 'return patch "stander" { defaults = { mass = 80 } }'
on; (cd "$tree" && "$program" mod list scenes/yard.yaml) | grep -q '^3. later'; verdict "load_after changes the order" $?
mod later "apii: 1" ; says "a misspelt key of mod.yaml" 3 "later/mod.yaml:4:1: unknown key 'apii'" bash -c "cd $tree && $program mod check scenes/mods/later"
: >"$tree/scenes/mods/later/mod.yaml"; says "an empty mod.yaml is reported as empty" 3 "later/mod.yaml:1:1: this file of a mod is empty. Example: {name: calm," bash -c "cd $tree && $program mod check scenes/mods/later"
printf 'name: later\nversion: 1.0\napi: 2\n' >"$tree/scenes/mods/later/mod.yaml"; says "another api version is refused" 3 "later/mod.yaml:3:6: api must be from 1 to 1" bash -c "cd $tree && $program mod check scenes/mods/later"
rm -r "$tree/scenes/mods/later" "$tree/scenes/mods/zeta"
mod links ""; ln -s /etc/passwd "$tree/scenes/mods/links/patches/stander.lua"
says "symbolic links are refused" 0 "symbolic links are not followed" bash -c run
rm -r "$tree/scenes/mods/links"
mod large ""; head -c 2000000 /dev/zero | tr '\0' ' ' >"$tree/scenes/mods/large/patches/stander.lua"
says "large files are refused" 0 "it is over 1 MB" bash -c run
rm -r "$tree/scenes/mods/large"
mod lost "" nobody.lua 'return patch "nobody" { defaults = { radius = 0.3 } }'
says "check: an unknown target of a patch" 3 "lost/patches/nobody.lua:1:14: there is no behaviour 'nobody' to change" bash -c "cd $tree && $program check scenes"
rm -r "$tree/scenes/mods/lost"
mod states "" stander.lua 'return patch "stander" { states = { Stnd = { change = { x = { chance = 1 } } } } }'
says "a patch of an unknown state is refused" 0 "states/patches/stander.lua:1:37: there is no state 'Stnd' to change. Did you mean 'Stand'?" bash -c run
mod states "" stander.lua 'return patch "stander" { states = { Stand = { { to = "Stand" } } } }'
says "a patch that adds a transition without a position is refused" 0 "need a place. Say where: insert_before" bash -c run
mod states "" stander.lua 'while true do end return patch "stander" {}'
says "a patch that never ends is stopped" 0 "too long" bash -c run
mod states "" stander.lua 'return replace "stander" { name = "stander", start = "Go", states = { Go = { steer = drift(1, 0) } } }'
says "a mod can replace a behaviour" 0 '"stander": {"Go": 2}' bash -c run
mod states "" yard.yaml 'patch: yard
groups: {g: ~, h: {behaviour: walker.lua, at: [[5, 5]], set: {goal: goal}}}'
rm -f "$tree/scenes/mods/states/patches/stander.lua"
says "a patch of the scene takes a group away and adds one" 0 '"agents": 1' bash -c run
mkdir -p "$tree/scenes/mods/states/behaviours" "$tree/scenes/mods/states/scenes"; cp "$tree/behaviours/stander.lua" "$tree/scenes/mods/states/behaviours/post.lua"
printf 'patch: yard\ngroups: {g: {behaviour: "states:post"}}\n' >"$tree/scenes/mods/states/patches/yard.yaml"
says "a scene can use a mod's behaviour by mod:name" 0 'mods/states/behaviours/post.lua' bash -c run
printf 'patch: yard\ngroups: {g: {cont: 3}}\n' >"$tree/scenes/mods/states/patches/yard.yaml"
says "an error in a patch of the scene has its line and column" 0 "states/patches/yard.yaml:2:14: unknown key 'cont' of a group. Did you mean 'count'?" bash -c run
printf 'jostle: 1\nmods: {states: {}}\ngroups: {g: {behaviour: stander.lua, at: [[0, 0]]}}\n' >"$tree/scenes/named.yaml"
printf 'patch: yard\ninclude: /etc/passwd\n' >"$tree/scenes/mods/states/patches/yard.yaml"
says "a mod cannot include a file outside it" 0 "states/patches/yard.yaml:2:10: a mod cannot include '/etc/passwd'" bash -c run
grep -q root: "$work/out"; [ $? = 1 ]; verdict "no output shows that file" $?
printf 'patch: yard\ninput: ../../../../../../etc/passwd\n' >"$tree/scenes/mods/states/patches/yard.yaml"
says "the file is not read" 0 "a mod cannot read" bash -c run
"$program" mod disable "$tree/scenes/mods/states" >/dev/null
(cd "$tree" && "$program" mod list scenes/named.yaml) | grep -q '. states 1.0'; verdict "a scene can name its mods" $?

printf 'jostle: 1\nmods: [states]\ngroups: {g: {behaviour: stander.lua, at: [[0, 0]]}}\n' >"$tree/scenes/named.yaml"
says "mods given as a list are refused" 0 "scenes/named.yaml:2:7: mods maps names of mods to their settings" bash -c "cd $tree && $program run scenes/named.yaml --steps 1 --quiet"
mkdir -p "$XDG_DATA_HOME/jostle/mods/mine/patches"
printf 'name: mine\nversion: 3.1\napi: 1\n' >"$XDG_DATA_HOME/jostle/mods/mine/mod.yaml"
echo 'return patch "stander" { defaults = { mass = 90 } }' >"$XDG_DATA_HOME/jostle/mods/mine/patches/stander.lua"
says "a mod of the user's data directory is off at first" 0 "off: mine 3.1" "$program" mod list
says "it can be turned on" 0 "mod mine is on" "$program" mod enable mine
says "and is then loaded" 0 'mine 3.1' bash -c run
rm -r "$XDG_DATA_HOME/jostle"
# Other kinds of values, items changed twice, and long lists.
rm -rf "$tree/scenes/mods"/* "$tree/scenes/named.yaml"
printf 'jostle: 1\nplaces: {goal: {point: [9, 0]}}\nbodies:\n  - {name: ball, shape: {sphere: {radius: 0.1}}, mass: 0.4, at: [5, 5, 0.1]}\ngroups: {g: {behaviour: stander.lua, at: [[0, 0], [2, 0]]}}\n' >"$tree/scenes/yard.yaml"
mod odd "" yard.yaml 'patch: yard
groups: {g: {at: {1: [4, 0]}}}'
says "a list item that is a list replaces another" 0 '"mods": ["odd 1.0"]' bash -c run
mod odd "" yard.yaml 'patch: yard
bodies: {ball: [1, 2]}'
says "a list in place of a map is an error with line and column" 0 "odd/patches/yard.yaml:2:16: a body is a map of keys" bash -c run
mod odd "" yard.yaml 'patch: yard
bodies: {ball: {mass: -1}, 0: {restitution: 0.5}}'
says "an item changed by two patches keeps both changes" 0 "odd/patches/yard.yaml:2:23: mass must be" bash -c run
# A mod that breaks the scene is the one that is left out.
rm "$tree/scenes/mods/odd/patches/yard.yaml"
printf 'return machine { name = "turner", start = "Go", states = {\n  Go = { steer = hold, { to = "Turn", when = after(1) } }, Turn = { become = "stander" } } }\n' >"$tree/behaviours/turner.lua"
sed -i 's/stander.lua/turner.lua/' "$tree/scenes/yard.yaml"
left="mod odd is left out"
broken() { # NAME PLACE-AND-TEXT PATCH-FILE TEXT
    mod odd "" "$3" "$4"
    says "$1" 0 "$2" bash -c run
    grep -qF "$left" "$work/out"; verdict "  and the mod is left out" $?
    rm "$tree/scenes/mods/odd/patches/$3"
}
broken "a patch of a machine that agents become" "odd/patches/stander.lua:1:47: unknown key 'psh'" stander.lua 'return patch "stander" { states = { Stand = { psh = 3 } } }'
broken "a patch to become an unknown machine is refused" "odd/patches/turner.lua:1:45: there is no behaviour 'nobody'" turner.lua 'return patch "turner" { states = { Turn = { become = "nobody" } } }'
broken "a patch that needs a value that no group sets is refused" "odd/patches/turner.lua:1:55: 'quickness' is no parameter" turner.lua 'return patch "turner" { states = { Go = { speed = own.quickness } } }'
broken "a value that no behaviour has is refused" "odd/patches/yard.yaml:2:20: behaviour turner has no 'nothing'" yard.yaml 'patch: yard
groups: {g: {set: {nothing: 3}}}'
broken "items in place of names are refused" "odd/patches/stander.lua:1:26: this table of a patch takes names as keys" stander.lua 'return patch "stander" { states = { { to = "Stand" } } }'
broken "a patch that sets too many values is refused" "patches set more than 4096 things" stander.lua 'local t = {} for i = 1, 30000 do t["k" .. (i * 7919 % 30011)] = i end return patch "stander" { defaults = t }'
broken "too many transitions are refused" "states.Stand has too many transitions" stander.lua 'local t = {} for i = 1, 400 do t[i] = { to = "Stand" } end return patch "stander" { states = { Stand = { append = t } } }'
mod odd "" x.lua 'return 7'
says "an empty patch leaves its mod out" 0 "this file names no behaviour that it changes" bash -c run
grep -qF '"mods": []' "$work/out"; verdict "  with its other patches" $?
rm -rf "$tree/scenes/mods"/*
says "why says so if the scene does not load" 3 "unknown key 'nme'" bash -c "cd $tree && printf 'jostle: 1\nnme: 3\n' >scenes/bad.yaml && $program mod why stander.push scenes/bad.yaml"
# Positions in another mod's text; ids after transitions were removed.
mod one "" stander.lua 'return patch "stander" { states = {
 Go = { steer = drift(1, 0),
 { to = "Stand", when = after(5) } },
 Stand = { append = { { to = "Go", when = after(1) }, { to = "Go", when = after(2) }, { to = "Go", when = after(3) } } } } }'
mod two "depends: one" stander.lua 'return patch "stander" { states = { Go = { push = 5 }, Stand = { remove = { "Go#2" } } } }'
mod three "depends: two" stander.lua 'return patch "stander" { states = { Stand = { append = { to = "Go", when = after(4) } } } }'
sed -i 's/turner.lua/stander.lua/' "$tree/scenes/yard.yaml"
on
says "why: in a state that another mod wrote" 0 "one/patches/stander.lua:3:18: after(5)   (mod one 1.0)" "$program" mod why stander.Go.Stand.when "$tree/scenes/yard.yaml"
says "the id of a removed transition can be used again" 0 "three/patches/stander.lua:1:69: after(4)   (mod three 1.0)" "$program" mod why "stander.Stand.Go#2.when" "$tree/scenes/yard.yaml"
says "the id of the next transition stays the same" 0 "one/patches/stander.lua:4:100: after(3)   (mod one 1.0)" "$program" mod why "stander.Stand.Go#3.when" "$tree/scenes/yard.yaml"
# A transition removed and appended in one patch: `why` shows the present one, and what removed the other.
# A part that a library builds is attributed to the line that calls it.
mkdir -p "$work/built"
cat >"$work/built/w.lua" <<'END'
local lib = require "lib"
return machine { name = "w", start = "A", defaults = lib.slow,
  states = {
    A = lib.stand(1),
    B = lib.stand(2),
    C = { steer = hold, lib.leave("A") } } }
END
cat >"$work/built/lib.lua" <<'END'
return { slow = { max_speed = 1.5 },
  stand = function(s) return { steer = hold, speed = s, { to = "C", when = after(s) } } end,
  leave = function(to) return { to = to, when = after(1) } end }
END
printf 'jostle: 1\nduration: 1\ngroups: {g: {behaviour: w.lua, at: [[0, 0]]}}\n' >"$work/built/s.yaml"
while read -r path text; do
    says "why finds what a library built: $path" 0 "$text" "$JOSTLE" mod why "$path" "$work/built/s.yaml"
done <<'END'
w.A.speed w.lua:4:5: lib.stand(1)
w.B.speed w.lua:5:5: lib.stand(2)
w.B.C w.lua:5:5: lib.stand(2)
w.B.C.when w.lua:5:5: lib.stand(2)
w.C.A w.lua:6:25: lib.leave("A")
w.C.max_speed w.lua:2:43: lib.slow
w.C.speed the default: 1.3 m/s
w.A.push the default: 0 N
END

rm -rf "$tree/scenes/mods"/*
cat >"$tree/behaviours/goer.lua" <<'END'
return machine { name = "goer", version = 10, start = "Go", states = {
  Go = { steer = seek(own.goal), lasts = 1,
    { to = "Stay", when = lasted } },
  Stay = { steer = hold, lasts = 2,
    { to = "Go", when = lasted } } } }
END
sed 's/stander.lua/goer.lua/; s/at: \[\[0, 0\], \[2, 0\]\]/at: [[0, 0]], set: {goal: goal}/' "$tree/scenes/yard.yaml" >"$tree/scenes/going.yaml"
mod later "" goer.lua 'return patch "goer" {
 states = { Stay = { remove = { "Go" },
 append = { { to = "Go", when = after(7) } } },
 Go = (function() return { speed = 2, append = { { to = "Stay", id = "tired", when = after(3) } } } end)() } }'
printf 'patch: going\nplaces: {far: {point: [90, 2]}}\ngroups: {g: {set: {goal: far}}}\n' >"$tree/scenes/mods/later/patches/going.yaml"
going=("$tree/scenes/going.yaml" --mod later)
says "why: a transition that was removed and appended" 0 "later/patches/goer.lua:3:26: after(7)   (mod later 1.0)" "$program" mod why goer.Stay.Go.when "${going[@]}"
[ "$(grep -c 'goer.lua:5:\|later/patches/goer.lua:2:22: taken away' "$work/out")" = 2 ] && tail -2 "$work/out" | head -1 | grep -q 'after(7)'; verdict "  with the patch that removed the first one" $?
says "  for the whole transition" 0 "taken away   (mod later 1.0)" "$program" mod why goer.Stay.Go "${going[@]}"
says "why: a value of a scene that a mod sets, as it is written" 0 "going.yaml:3:20: far   (mod later 1.0)" "$program" mod why groups.g.set.goal "${going[@]}"
says "  a list value" 0 "[90, 2]   (mod later 1.0)" "$program" mod why places.far.point "${going[@]}"
says "  a place of an agent, by its name" 0 "goal of agent 0 at 1.00 s, in state Go: far" "$program" mod why goal "${going[@]}" --agent 0 --at 1
grep -qF "going.yaml:3:20: far   (groups.g)" "$work/out"; verdict "    as the scene writes it" $?
says "  a value that a function of a mod made, in the mod's file" 0 "later/patches/goer.lua:4:" "$program" mod why speed "${going[@]}" --agent 0 --at 0.5
says "a transition of a mod is traced to the mod's file" 0 "patches/goer.lua:3)" "$program" run "${going[@]}" --trace 0 --for 12 --quiet
# A mod in mods/ is checked alike from within and from above, with what lies beside it; so are its parts.
mod needy "depends: [later]" stander.lua 'return patch "stander" { defaults = { radius = 0.2 } }'
mkdir -p "$tree/scenes/mods/needy/scenes"; cp "$tree/scenes/yard.yaml" "$tree/scenes/mods/needy/scenes/own.yaml"
says "a mod is checked by its name" 0 "nothing wrong" bash -c 'cd "$tree" && "$program" mod check needy'
for from in . scenes scenes/mods scenes/mods/needy scenes/mods/needy/patches; do
    for to in scenes/mods/needy scenes/mods/needy/ scenes/mods scenes/mods/needy/patches scenes/mods/needy/mod.yaml scenes/mods/needy/scenes/own.yaml; do
        path=$(realpath --relative-to="$tree/$from" "$tree/$to")
        says "mod check $path from $from" 0 "nothing wrong" bash -c "cd '$tree/$from' && '$program' mod check $path"
    done
done
says "mod check finds a mistake for a path with a slash at its end" 3 "radius must be" bash -c 'cd "$tree" && sed -i "s/0.2/99/" scenes/mods/needy/patches/stander.lua && "$program" mod check scenes/mods/needy/'
mod needy "depends: [later]" stander.lua 'return patch "stander" { defaults = { radius = 0.2 } }'
# A mod's scenes go by their names.
for from in . scenes scenes/mods scenes/mods/needy; do
    says "a scene of a mod by its name, from $from" 0 '"steps": 2' bash -c "cd '$tree/$from' && '$program' run own --mod $([ $from = scenes/mods/needy ] && echo ../)needy --mod $([ $from = scenes/mods/needy ] && echo ../)later --steps 2 --quiet --summary -"
done
cp "$tree/scenes/yard.yaml" "$tree/scenes/own.yaml"
says "a scene name that two mods have is refused" 3 "scenes/own.yaml or scenes/mods/needy/scenes/own.yaml" bash -c 'cd "$tree" && "$program" run own --mod needy --mod later --steps 2'
says "  not as MOD:NAME" 0 '"steps": 2' bash -c 'cd "$tree" && "$program" run needy:own --mod needy --mod later --steps 2 --quiet --summary -'
# Order, in large and in circles.
rm -rf "$tree/scenes/mods"/*
names=; for i in $(seq 10 49); do mod m$i "depends: [$names]"; names="$names${names:+, }m$i"; done
on
says "forty mods, each with all before as dependencies, load" 0 "40. m49 1.0" timeout 10 "$program" mod list "$tree/scenes/yard.yaml"
for i in $(seq 50 80); do mod m$i ""; done
says "more mods than the limit are an error" 3 "m74/mod.yaml:1:1: there are over 64 mods" "$program" mod list "$tree/scenes/yard.yaml"
rm -rf "$tree/scenes/mods"/*
mod aaa "depends: yy"; mod zz "load_after: yy"; mod yy "load_after: zz"
on
says "a circle of load_after is reported, and dependencies still come first" 0 "3. aaa 1.0" "$program" mod list "$tree/scenes/yard.yaml"
grep -qF "zz/mod.yaml:4:13: warning: mod zz would come after yy, which comes after it: not heeded" "$work/out"; verdict "  with line and column" $?
rm -rf "$tree/scenes/mods"/*
mod aaa "depends: 'bb <= 2'"; mod bb "settings: {x: {value: 5, least: 1, greatest: 8}}"
on
says "an unknown comparison of versions is refused" 0 "aaa/mod.yaml:4:10: depends: 'bb <= 2' is no name of a mod" bash -c run
sed -i '1a mods: {bb: {x: 99}}' "$tree/scenes/yard.yaml"
says "a setting out of range in the scene has the scene's line" 0 "scenes/yard.yaml:2:16: setting 'x' of mod bb must be from 1 to 8, not 99" bash -c run
says "one from the command line has that position" 0 "--set:1:1: setting 'x' of mod bb must be from 1 to 8, not 77" bash -c "run --set mods.bb.x=77"

# mod why of machines that no table writes out as a whole.
mkdir -p "$work/parts"
cat >"$work/parts/lib.lua" <<'END'
local mine = memory { laps = 0 }
local lib = {}
function lib.wait(seconds)
  return { steer = hold, lasts = seconds, face = "post", speed = 1.5,
    { to = "B", when = lasted } }
end
function lib.whole(name)
  return machine { name = name, start = "A", defaults = { perception = 5 },
    counts = { laps = circuits "post" },
    states = { A = { steer = seek "post", speed = 1, { to = "B", when = after(3), chance = 0.5 } },
      B = { steer = hold, { to = "A", id = "back", set = { laps = 0 }, when = after(9) } } } }
end
return lib
END
printf 'return require("lib").whole("whole")\n' >"$work/parts/whole.lua"
printf 'local lib = require "lib"\nreturn machine { name = "one", start = "A", states = { A = lib.wait(2), B = { removes = true } } }\n' >"$work/parts/one.lua"
printf 'local all = {}\nfor i = 1, 2 do\n  all[i == 1 and "A" or "B"] = { lasts = i, steer = hold,\n    { to = i == 1 and "B" or "A", when = lasted } }\nend\nreturn machine { name = "loop", start = "A", states = all }\n' >"$work/parts/loop.lua"
cat >"$work/parts/set.lua" <<'END'
local m = { name = "set", start = "A", states = {} }
m.states.A = { steer = hold, speed = 2 }
m.states.A.speed = 0.4
m.states.A[1] = { to = "B", when = after(2) }
local last = { removes = true }
m.states["B"] = last
return machine(m)
END
{ printf 'jostle: 1\nplaces: {post: {point: [0, 0], radius: 5}}\ngroups:\n'
    for name in whole one loop set; do printf '  %s: {behaviour: %s.lua, count: 1, in: post}\n' $name $name; done; } >"$work/parts/scene.yaml"
while read -r path place; do
    told=$("$JOSTLE" mod why "$path" "$work/parts/scene.yaml" 2>/dev/null | sed -n "s|^ *$work/parts/||p" | tail -1)
    [ "$told" = "$place" ] || echo "$path: '$told' for '$place'"
done >"$work/out" <<'END'
whole.A.steer lib.lua:10:22: seek "post"
whole.A.speed lib.lua:10:43: 1
whole.A.B.chance lib.lua:10:83: 0.5
whole.B.back.set.laps lib.lua:11:60: 0
whole.A.perception lib.lua:8:59: 5
whole.counts.laps lib.lua:9:16: circuits "post"
whole.start lib.lua:8:33: "A"
one.A.steer lib.lua:4:12: hold
one.A.lasts lib.lua:4:26: seconds
one.A.speed lib.lua:4:58: 1.5
one.A.B.when lib.lua:5:17: lasted
one.B.removes one.lua:2:79: true
loop.A.lasts loop.lua:3:34: i
loop.B.A.when loop.lua:4:35: lasted
set.A.speed set.lua:3:12: 0.4
set.A.steer set.lua:2:16: hold
set.A.B.when set.lua:4:29: after(2)
set.B.removes set.lua:5:16: true
END
[ ! -s "$work/out" ]; verdict "mod why finds parts that functions, loops and assignments make" $?
[ ! -s "$work/out" ] || cat "$work/out"
says "why of a key that a state lacks has no position" 3 "nothing sets 'one.A.kick'" "$JOSTLE" mod why one.A.kick "$work/parts/scene.yaml"

# Machines that states run: mods reach into them by whole names and by paths, and `mod why` does.
mkdir -p "$work/night/patches"
printf 'name: night\nversion: 1.0\napi: 1\n' >"$work/night/mod.yaml"
cat >"$work/night/patches/warden.lua" <<'END'
return patch "warden" { states = {
  ["Night.Round.Walk"] = { push = 80, change = { Look = { chance = 0.5 } } },
  Night = { runs = { states = { Sit = { perception = 2 }, Round = { change = { Call = { when = after(0.4) } } } } } },
  ["Day.Turn"] = { speed = 0.3 },
} }
END
says "a mod changes states within outer ones" 0 '"night 1.0"' "$JOSTLE" run tests/data/nested.yaml --mod "$work/night" --for 2 --quiet --summary -
while read -r path place; do
    told=$("$JOSTLE" mod why "$path" tests/data/nested.yaml --mod "$work/night" 2>/dev/null | grep -E "^  .*:[0-9]+:[0-9]+:" | tail -1)
    case $told in *"$place"*) ;; *) echo "$path: '$told' for '$place'" ;; esac
done >"$work/out" <<'END'
warden.Night.Round.Walk.push night/patches/warden.lua:2:28: 80
warden.Night.Round.Walk.Look.chance night/patches/warden.lua:2:59: 0.5
warden.Night.Round.Call.when night/patches/warden.lua:3:89: after(0.4)
warden.states.Night.runs.states.Sit.perception night/patches/warden.lua:3:41: 2
warden.Day.Turn.speed night/patches/warden.lua:4:20: 0.3
warden.Day.Turn.lasts nested/warden.lua:
warden.Night.Round.Walk.speed nested/warden.lua:14:34: 0.9
guard.Guard.Walk.steer nested/patrol.lua:9:14: seek "east"
guard.Guard.Walk.push nested/guard.lua:10:57: 20
guard.Guard.Walk.horizon nested/guard.lua:7:16: 0.5
guard.Guard.Walk.perception nested/patrol.lua:6:41: 4
END
[ ! -s "$work/out" ]; verdict "mod why finds what states within outer ones set and inherit" $?
[ ! -s "$work/out" ] || cat "$work/out"
sed 's/Round.Walk"/Round.Wlk"/' "$work/night/patches/warden.lua" >"$work/night/patches/odd.lua" && mv "$work/night/patches/odd.lua" "$work/night/patches/warden.lua"
says "a misspelt state within outer ones is refused" 3 "warden.lua:2:4: there is no state 'Wlk' to change. Did you mean 'Walk'?" "$JOSTLE" run tests/data/nested.yaml --mod "$work/night" --for 0.1 --quiet

# jostle new: what it writes passes the check and runs.
mkdir "$work/new"
(cd "$work/new" && "$program" new behaviour shy && "$program" new scene hall && "$program" new mod calm) >"$work/out" 2>&1; verdict "new writes a behaviour, a scene and a mod" $?
says "the new files pass the check" 0 "nothing wrong" bash -c "cd $work/new && $program check ."
says "the new scene runs" 0 '"Go"' bash -c "cd $work/new && $program run hall.yaml --for 5 --quiet --summary -"
says "the new mod's scene runs with the mod" 0 '"calm 1.0.0"' bash -c "cd $work/new && $program run mods/calm/scenes/calm.yaml --mod mods/calm --for 5 --quiet --summary -"
mkdir -p "$work/new/deep/scenes"
says "a scene in scenes/ finds its behaviour" 0 '"Go"' bash -c "cd $work/new/deep && $program new scene hall && $program run scenes/hall.yaml --for 2 --quiet --summary -"
says "new overwrites nothing" 1 "is there already" bash -c "cd $work/new && $program new behaviour shy"
ln -s ../leads-nowhere.lua "$work/new/odd.lua"; ln -s ../leads-nowhere.yaml "$work/new/strange.yaml"
says "new does not follow a broken symbolic link" 1 "or a link" bash -c "cd $work/new && $program new behaviour odd"
says "  nor for a scene" 1 "or a link" bash -c "cd $work/new && $program new scene strange"
[ ! -e "$work/new/strange.lua" ]; verdict "a scene that cannot be written leaves no behaviour" $?
[ ! -e "$work/leads-nowhere.lua" ] && [ ! -e "$work/leads-nowhere.yaml" ]; verdict "  and nothing is written there" $?
says "new refuses a bad name" 2 "lower-case letters" "$JOSTLE" new scene ../up
says "new without a kind is refused" 2 "there is no kind 'world'; there are behaviour, scene, mod" "$JOSTLE" new world x
exit 0
