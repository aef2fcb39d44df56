# Warnings of `check` about names that machines use of each other and that the scene gives: memory, messages, states, teams.
. tests/scenes/lib.sh

# says NAME TEXT: `check` of the scene $work/s.yaml prints a text that holds TEXT, and passes
says() { expect "$1" 0 "$2" "$JOSTLE" check "$work/s.yaml"; }
# silent NAME TEXT: it does not print TEXT
silent() { "$JOSTLE" check "$work/s.yaml" >"$work/said" 2>&1; ! grep -q "$2" "$work/said"; verdict "$1" $?; }

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

# ---- names that machines use of each other: the nearest is proposed, at its line ----
behaviour() { # NAME TEXT: one group runs a machine of states A and B with this memory, public, and item of A
    cat >"$work/$1.lua" <<END_OF_LUA
local mine = memory { busy = false, pain = 0 }
return machine { name = "$1", start = "A", public = "busy", own = { first = 0 }, states = {
  A = { steer = hold, { when = after(1), set = { busy = true, pain = 1 } },
    $2 },
  B = { steer = hold } } }
END_OF_LUA
}
printf 'jostle: 1\nplaces: {hall: {polygon: [[0, 0], [4, 0], [4, 4], [0, 4]]}}\ngroups:\n  a: {behaviour: a.lua, at: [[0, 0]], tags: [p]}\n  b: {behaviour: b.lua, at: [[2, 0]], tags: [p]}\n' >"$work/s.yaml"
behaviour b '{ to = "B", when = after(1), tell = { nearest "p", "pas", hops = 2 } }'
behaviour a '{ to = "B", when = told("pass") & told("pass").hop:above(0) }'
says "check proposes the name of a message that is told" "a.lua:4:29: warning: no machine of the scene tells a message 'pass'. Did you mean 'pas'?"
says "  and of one that is asked for, with its line" "b.lua:4:34: warning: no machine of the scene asks for the message 'pas'. Did you mean 'pass'?"
says "  and of a value that it carries" "no message of the scene carries a value 'hop'. Did you mean 'hops'?"
behaviour a '{ to = "B", when = heard "pas" }'
says "  heard() of a message is told of" "It is a message: when = told"
behaviour a '{ to = "B", when = exists(nearest("p"):where("bsy")) & theirs(nearest "p", "bussy"):above(0) }'
says "check proposes the name of public memory in where" "makes memory 'bsy' public. Did you mean 'busy'?"
says "  and in theirs" "makes memory 'bussy' public. Did you mean 'busy'?"
sed -i 's/"bsy"/"pain"/' "$work/a.lua"
says "  not of memory that is there, but not public" "makes memory 'pain' public. In the machine that remembers it"
fails() { expect "$1" 3 "$2" "$JOSTLE" check "$work/s.yaml"; }
behaviour a '{ to = "B", when = own.fist:above(0) }'
fails "check proposes an own value before a parameter" "Did you mean 'own.first'?"
behaviour a '{ to = "B", when = own.pain:above(0) }'
fails "  and memory of that name" "It is in memory: mine.pain"
behaviour a '{ to = "B", when = arrived "goal" }'
fails "check says that goal is a word" "The word stands without quotes: arrived(goal)"

# ---- messages that an item reads ----
behaviour a '{ to = "B", when = exists(told("pass").sender), set = { pain = told("pass").hops } }'
silent "an item may name its message by who told it" "done also while none waits"
sed -i 's/when = exists(told("pass").sender)/when = after(1)/' "$work/a.lua"
says "  but must name it" "done also while none waits"
