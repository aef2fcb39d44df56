# Hostile behaviours (tests/attacks, one attack per file): each is the behaviour of three agents beside twenty
# honest walkers. None may hang or crash the run, read files of others, or change what other agents do. The first
# line of a file gives the expected outcome:
#   -- expects: load-error TEXT   it does not load, and TEXT is printed
#   -- expects: run TEXT          it loads, its functions fail, and TEXT is printed
#   -- expects: harmless          it loads and runs without an error
#   -- expects: acts TEXT         as harmless, but its agents act, so that the hash is not compared
#   -- expects: stop TEXT         it loads, and ends the run, as its time has no limit
# With `run` and `harmless` the hash of the state, without the counts of failed functions, must be that of agents
# that do nothing.
. tests/scenes/lib.sh
TIMEFORMAT='%U %S'
SLOWER=${SLOWER:-1} # factor by which a build is slower (sanitisers)
HANGS=${HANGS:-10}  # s of processor time above that of an honest run at which an attack counts as a hang
yard=$work/yard
mkdir -p "$yard"

inert='return machine { name = "m", start = "A", states = { A = { steer = hold } } }'
printf '%s\n' "$inert" >"$yard/inert.lua"
cat >"$yard/honest.lua" <<'END'
local mine = memory { turns = 0 }
return machine { name = "honest", start = "There",
  defaults = { speed = normal(1.3, 0.2), perception = 5 },
  states = {
    There = { steer = seek "east", { to = "Back", when = near("east", 1) | after(1) } },
    Back = { steer = seek "west", on_enter = function(me) me.turns = me.turns + math.random(3) end,
      { to = "There", when = near("west", 1) | after(1) } },
  } }
END
scene() { # BEHAVIOUR: prints the scene, with attackers unless BEHAVIOUR is empty
    cat <<END
jostle: 1
limits: {${limits:-}}
places:
  yard: {polygon: [[0, 0], [20, 0], [20, 20], [0, 20]]}
  corner: {polygon: [[60, 60], [76, 60], [76, 76], [60, 76]]}
  west: {point: [2, 10]}
  east: {point: [18, 10]}
groups:
  honest: {behaviour: honest.lua, count: 20, fill: grid, in: yard, tags: [people]}
END
    [ -z "$1" ] || echo "  hostile: {behaviour: $1, count: ${count:-3}, fill: grid, in: corner}"
}
# within LIMIT < "USER SYSTEM": prints the sum of both times, s; fails if it is above the limit
within() { awk -v m="$1" '{printf "%.2f", $1 + $2; exit !($1 + $2 <= m)}'; }
run() { # BEHAVIOUR: runs the scene; sets $status and $hash, writes times to $work/time and output to $work/out
    scene "$1" >"$yard/scene.yaml"
    { time timeout $((20 * SLOWER)) "$JOSTLE" run "$yard/scene.yaml" --steps 40 --quiet \
        --summary "$work/summary" >"$work/out" 2>&1 </dev/null; } 2>"$work/time"
    status=$?
    hash=$([ $status -le 1 ] && figure hash_without_hooks <"$work/summary")
}
run ""
alone=$hash
printf 'local mine = memory { n = 0 }\n%s\n' "$inert" >"$yard/mindful.lua"
run mindful.lua
mindful=$hash
run inert.lua
quiet=$hash
honest=$(within 1000 <"$work/time")
most=$(awk -v h="$honest" -v s="$SLOWER" -v t="$HANGS" 'BEGIN {print h + t * s}')
[ -n "$alone" ] && [ -n "$quiet" ]; verdict "runs without attackers end" $?

attack() { # FILE EXPECTS TEXT: runs an attack and checks its outcome
    local name wanted=0 took slow same
    name=$(basename "$1" .lua)
    run "$(basename "$1")"
    same=$quiet
    [ ! -f "$yard/$name.lua" ] || ! grep -q "^local mine = memory { n = 0 }" "$yard/$name.lua" || same=$mindful
    took=$(within "$most" <"$work/time"); slow=$?
    case $2 in load-error) wanted=3 ;; stop) wanted=1 ;; esac
    ! grep -q '^jostle run: behaviour ' "$work/out" || wanted=1 # the run goes on to its end
    if [ $status != $wanted ]; then
        echo "not ok $name: status $status, wanted $wanted"; head -5 "$work/out"
    elif [ $slow != 0 ]; then echo "not ok $name: took $took s of processor time, at most $most"
    elif [ -n "$3" ] && ! grep -qF -- "$3" "$work/out"; then
        echo "not ok $name: did not say '$3'"; head -5 "$work/out"
    elif [ "$2" = run ] && ! [ -s "$work/out" ]; then echo "not ok $name: nothing was said"
    elif [ $(wc -c <"$work/out") -gt 60000 ]; then echo "not ok $name: floods, $(wc -c <"$work/out") bytes"
    elif ! iconv -f utf-8 "$work/out" >/dev/null 2>&1; then
        echo "not ok $name: said what is not text"
    elif grep -q $'[\001-\010\013-\037\177]' "$work/out"; then echo "not ok $name: commands the terminal"
    elif [ -n "$hash" ] && [ "$2" != stop ] && [ "$2" != acts ] && [ "$hash" != "$same" ]; then echo "not ok $name: hash $hash, not $same"
    else echo "ok $name ($took s)"; fi
}
attack_file() { # FILE: runs an attack; its first line gives the outcome
    local line what text
    cp -P "$1" "$yard/"
    line=$(head -1 "$1" | tr -d '\000\r')
    line=${line#*-- expects: }
    what=${line%% *} text=
    [ "$what" = "$line" ] || text=${line#* }
    attack "$1" "$what" "$text"
}
generated() { # NAME EXPECTS TEXT < content: runs an attack that is generated here
    cat >"$yard/$1.lua"
    attack "$1.lua" "$2" "$3"
}
times() { awk -v n="$1" -v t="$2" 'BEGIN {for (i = 0; i < n; i++) printf "%s", t}'; }

for file in ${ATTACKS:-tests/attacks/*.lua}; do attack_file "$file"; done
# Many attackers: a function that fails a hundred times in a second is suspended.
count=30
run inert.lua
few=$quiet quiet=$hash
for name in hook_loops hook_loops_in_pcall hook_throws_a_thousand_times hook_memory; do
    cp tests/attacks/$name.lua "$yard/horde_$name.lua"
    attack horde_$name.lua run "was suspended"
done
count=600
run inert.lua
quiet=$hash
cp tests/attacks/hook_busy.lua "$yard/horde_hook_busy.lua"
attack horde_hook_busy.lua run "was suspended"
count=3 quiet=$few

# A scene can set the limits.
limits="source: 1"
{ times 20 "-- 0123456789012345678901234567890123456789012345678901234567890\n"; echo "$inert"; } |
    generated limit_of_source load-error "over 1 KB"
limits="load_instructions: 10000"
{ echo 'for i = 1, 20000 do end'; echo "$inert"; } | generated limit_of_loading load-error "too long"
limits="instructions: 2000"
cp tests/attacks/hook_busy.lua "$yard/limit_of_functions.lua"
attack limit_of_functions.lua run "too long"
limits="step_instructions: 20000"
cp tests/attacks/hook_busy.lua "$yard/limit_of_steps.lua"
attack limit_of_steps.lua run "too long"
limits="block: 0.1"
{ echo 'local s = ("x"):rep(200000)'; echo "$inert"; } | generated limit_of_blocks load-error "memory"
limits="memory: 1"
{ echo 'local t = {} for i = 1, 30 do t[i] = ("x"):rep(50000 + i) end'; echo "$inert"; } |
    generated limit_of_memory load-error "memory"
limits="print: 0"
{ echo 'print("a")'; echo "$inert"; } | generated limit_of_print harmless "print is limited"
limits="print: 1.5"
generated limit_in_halves load-error "print" <<<"$inert"
limits=

# Bytes that a text file must not have, and files that are too long.
printf '\033Lua%s' "$inert" | generated bytecode load-error "compiled Lua"
printf '%s\n--\0\n' "$inert" | generated zero_byte load-error "zero byte"
printf '\357\273\277%s\n' "$inert" | generated byte_order_mark harmless ""
printf '%s\r\n' "-- a remark" "$inert" | generated carriage_returns harmless ""
printf -- '-- \377\376\200\n%s\n' "$inert" | generated not_utf8 load-error ""
printf 'local \377 = 1\n' | generated not_utf8_in_code load-error ""
{ times 4096 "-- 0123456789012345678901234567890123456789012345678901234567890\n"; echo "$inert"; } |
    generated one_line_over_256_kb load-error "256 KB"
{ times 4000 "-- 01234567890123456789012345678901234567890123456789012345678\n"; echo "$inert"; } |
    generated just_below_256_kb harmless ""
{ printf 'return '; times 100000 '('; } | generated nested_parentheses load-error ""
{ printf 'return '; times 100000 '{'; } | generated nested_tables load-error ""
{ times 20000 'machine{'; } | generated nested_machines load-error ""
{ times 20000 'function() '; } | generated nested_functions load-error ""
{ times 30000 'do '; } | generated nested_blocks load-error ""
{ printf 'local x = '; times 60000 '- -'; printf '1\n'; } | generated nested_minus load-error ""
{ printf 'local x = '; times 60000 'not '; printf '1\n'; } | generated nested_not load-error ""
{ printf 'local x = '; times 60000 '1 ..'; printf '1\n'; } | generated nested_concat load-error ""
{ printf 'local x = now.speed'; times 20000 ' + 1'; printf '\n%s\n' "$inert"; } | generated long_sum harmless ""
{ printf 'return '; times 20000 '[['; } | generated nested_brackets load-error ""
{ printf 'return [='; times 200000 '='; } | generated long_bracket load-error ""
{ times 300 'local a '; printf '\n%s\n' "$inert"; } | generated many_locals load-error "local variables"
{ printf 'local x = "'; times 20000 '\\x41\\z '; printf '"\n%s\n' "$inert"; } | generated escapes harmless ""
{ printf 'local '; times 200000 'x'; printf ' = 1\n%s\n' "$inert"; } | generated long_identifier harmless ""
{ printf 'local x = '; times 200000 'y'; printf '\n%s\n' "$inert"; } | generated long_unknown_word load-error "unknown word"
{ printf 'local x = { '; times 40000 'nope, '; printf '}\n%s\n' "$inert"; } | generated many_unknown_words load-error "unknown word"
{ printf 'local x = 0x'; times 200000 'f'; printf '\n%s\n' "$inert"; } | generated long_number harmless ""
{ printf 'return machine { name = "m", start = "A", states = { A = { '; times 20000 'sped = 1, '; printf '} } }\n'; } |
    generated many_wrong_keys load-error "sped"
{ printf 'return machine { name = "m", start = "A", states = { A = { { to = "A", when = lasted'
  times 12000 ' & now.speed:above(1)'; printf '} } } }\n'; } | generated long_condition load-error ""
# The compiler looks up a name in every enclosing function.
{ for i in $(seq 1 180); do
      printf 'local function f() local a'; for k in $(seq 1 180); do printf ',a'; done; echo
  done
  times 40000 'g=g '; } | generated names_in_deep_functions load-error "too long to compile"
{ printf 'return machine { name = "m", start = "S1", states = {\n'
  for i in $(seq 1 900); do
      printf 'S%d = { steer = hold, speed = 1, push = 1, mass = 60, perception = 2, horizon = 1, push_reach = 0.5,\n' $i
      printf '{ to = "S1", when = lasted & after(1), chance = 0.1 }, { to = "S2", when = lasted }, { to = "S3", when = lasted } },\n'
  done; printf '} }\n'; } | generated states_written_out acts ""
{ times 20000 'local a = 1 goto b ::b:: '; } | generated many_labels load-error ""

printf 'root:secret\n' >"$work/secret.lua"
ln -s "$work/secret.lua" "$yard/linked.lua"
attack linked.lua load-error "symbolic links"
echo 'require "linked"' | generated requires_link load-error "symbolic links"
mkdir "$work/outside"; printf 'return 7\n' >"$work/outside/x.lua"
ln -s "$work/outside" "$yard/door"
echo 'require "door/x"' | generated requires_through_link load-error "cannot require"
mkfifo "$yard/pipe.lua"
attack pipe.lua load-error "there is no behaviour"
echo 'require "pipe"' | generated requires_pipe load-error "no regular file"
mkdir "$yard/folder.lua"
attack folder.lua load-error "there is no behaviour"
echo 'require "folder"' | generated requires_folder load-error "no regular file"
printf '\033Lua' >"$yard/compiled.lua"
echo 'require "compiled"' | generated requires_bytecode load-error "compiled Lua"
for i in $(seq 1 70); do echo "require \"many$((i + 1))\"" >"$yard/many$i.lua"; done
echo 'require "many1"' | generated requires_seventy load-error ""
echo 'local t = {} for i = 1, 1e9 do t[i] = i end' >"$yard/eater.lua"
printf 'pcall(require, "eater")\n%s\n' "$inert" | generated requires_eater load-error "memory"

grep -rqF 'root:' "$work"/out*; [ $? != 0 ]; verdict "no output shows the contents of a secret file" $?
run ""
same_hash "unused files do not change the hash" "$alone" "$hash"
