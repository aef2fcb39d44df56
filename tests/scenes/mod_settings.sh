# Settings of mods: numbers, true or false, and choices; in mod.yaml, in a scene, on the command line.
. tests/scenes/lib.sh
program=$(case $JOSTLE in /*) echo "$JOSTLE" ;; *) echo "$PWD/$JOSTLE" ;; esac)
tree=$work/tree
mkdir -p "$tree/behaviours" "$tree/scenes/mods/calm/patches"
cp -R scripts "$tree/"
cp behaviours/stander.lua "$tree/behaviours/"
cd "$tree" || exit 1
printf 'jostle: 1\nplaces: {goal: {point: [9, 0]}}\ngroups: {g: {behaviour: stander.lua, at: [[0, 0], [2, 0]]}}\n' >scenes/yard.yaml
sheet() { # SETTINGS
    printf 'name: calm\nversion: 1.0\napi: 1\nsettings:\n%s\n' "$1" >scenes/mods/calm/mod.yaml
}
sheet '  shoves: {value: false, meaning: whether people push}
  manner: {value: polite, choices: [polite, rude], meaning: how people meet}
  reach: {value: 2, unit: m, least: 1, greatest: 9}'
cat >scenes/mods/calm/patches/stander.lua <<'END'
local radius = settings.manner == "polite" and 0.21 or settings.manner == "rude" and 0.29
return patch "stander" { defaults = {
  push = settings.shoves and 30 or 20, radius = radius, perception = settings.reach } }
END
value() { # NAME PARAMETER VALUE OPTION...: a parameter of agent 0
    local name=$1 parameter=$2 value=$3; shift 3
    expect "$name" 0 "$parameter of agent 0 at 0.00 s, in state Stand: $value" "$program" mod why "$parameter" scenes/yard.yaml --agent 0 --mod calm "$@"
}
run=("$program" run scenes/yard.yaml --steps 1 --quiet --mod calm)
value "a boolean" push 20
value "a choice" radius 0.21
value "a number" perception 2
expect "mod list names what each may be: a choice" 0 "manner = polite (polite, rude): how people meet" "$program" mod list scenes/yard.yaml --mod calm
expect "  a boolean" 0 "shoves = false (true, false): whether people push" "$program" mod list scenes/yard.yaml --mod calm
expect "  a number" 0 "reach = 2 m (1 to 9)" "$program" mod list scenes/yard.yaml --mod calm
cp scenes/yard.yaml yard.yaml
echo 'mods: {calm: {shoves: true, manner: rude, reach: 300 cm}}' >>scenes/yard.yaml
value "a scene sets a boolean" push 30
value "  a choice" radius 0.29
value "  a number with a unit" perception 3
hash() { "${run[@]}" --summary - "$@" 2>/dev/null | figure hash; }
set_in_scene=$(hash)
cp yard.yaml scenes/yard.yaml
same_hash "the command line sets the same" "$set_in_scene" "$(hash --set mods.calm.shoves=true --set mods.calm.manner=rude --set mods.calm.reach=3)"
expect "no boolean" 3 "--set:1:1: setting 'shoves' of mod calm must be true or false, not 'yes'. whether people push" "${run[@]}" --set mods.calm.shoves=yes
expect "no choice" 3 "setting 'manner' of mod calm must be polite or rude, not 'rud'. Did you mean 'rude'?" "${run[@]}" --set mods.calm.manner=rud
expect "no number" 3 "setting 'reach' of mod calm must be a number, not 'far'" "${run[@]}" --set mods.calm.reach=far
expect "a number out of its range" 3 "setting 'reach' of mod calm must be from 1 to 9, not 10" "${run[@]}" --set mods.calm.reach=10
expect "an unknown setting" 0 "'mods.calm.reech=1' names no setting of a mod" "${run[@]}" --set mods.calm.reech=1
echo 'mods: {calm: {shoves: 3}}' >>scenes/yard.yaml
expect "a scene's wrong value has its place" 3 "scenes/yard.yaml:4:23: setting 'shoves' of mod calm must be true or false, not '3'" "${run[@]}"
cp yard.yaml scenes/yard.yaml
echo 'mods: {calm: {manner: [rude]}}' >>scenes/yard.yaml
expect "  a list too" 3 "scenes/yard.yaml:4:23: setting 'manner' of mod calm takes one value" "${run[@]}"
cp yard.yaml scenes/yard.yaml
wrong() { # NAME TEXT SETTINGS
    sheet "$3"
    expect "$1" 3 "$2" "$program" mod check scenes/mods/calm
}
wrong "a text without choices" "mod.yaml:5:19: setting 'manner' must be a number, not 'rude'. A number, true or false, or a text of \`choices: [polite, rude]\`" '  manner: {value: rude}'
wrong "a value that is no choice" "mod.yaml:5:19: setting 'manner' must be polite or rude, not 'shy'" '  manner: {value: shy, choices: [polite, rude]}'
wrong "one choice" "mod.yaml:5:36: choices is a list of 2 to 32 different texts of at most 60 bytes" '  manner: {value: polite, choices: [polite]}'
wrong "the same choice twice" "choices is a list of 2 to 32 different texts" '  manner: {value: polite, choices: [polite, polite]}'
wrong "a boolean with a range" "'least' goes with numbers; setting 'shoves' is true or false" '  shoves: {value: true, least: 0}'
wrong "a choice with a unit" "'unit' goes with numbers; setting 'manner' is a choice" '  manner: {value: rude, choices: [polite, rude], unit: m}'
wrong "a number out of its own range" "setting 'reach' must be from 1 to 9, not 10" '  reach: {value: 10, least: 1, greatest: 9}'
