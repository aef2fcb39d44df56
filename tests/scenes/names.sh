# Warnings of `check` about names that machines use of each other and that the scene gives: memory, messages, states, teams.
. tests/scenes/lib.sh

# says NAME TEXT: `check` of the scene $work/s.yaml prints a text that holds TEXT, and passes
says() { expect "$1" 0 "$2" "$JOSTLE" check "$work/s.yaml"; }
# silent NAME TEXT: it does not print TEXT
silent() { "$JOSTLE" check "$work/s.yaml" >"$work/said"; ! grep -q "$2" "$work/said"; verdict "$1" $?; }

# ---- memory that nothing sets ----
cat >"$work/m.lua" <<'END_OF_LUA'
local mine = memory { laps = 0 }
return machine { name = "m", start = "A", states = {
  A = { steer = hold, { to = "B", when = mine.laps:above(2) } }, B = { steer = hold } } }
END_OF_LUA
printf 'jostle: 1\ngroups: {g: {behaviour: m.lua, at: [[0, 0]]}}\n' >"$work/s.yaml"
says "check warns of a number in memory that nothing sets" "m.lua:1:23: warning: memory 'laps' is read, and nothing sets it"
sed -i 's/at:/memory: {laps: 3}, at:/' "$work/s.yaml"
silent "  not if a group of the scene does" "nothing sets it"
