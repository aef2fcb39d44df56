# Tests of the shipped behaviours, and tests of the test runner.
. tests/scenes/lib.sh

"$JOSTLE" test tests/lua >"$work/shipped" 2>&1
status=$?
grep -E '^(ok|not ok) ' "$work/shipped" | sed 's/ ([0-9.]* s simulated in [0-9.]* s)$//'
[ "$status" = 0 ] || cat "$work/shipped"
verdict "the tests of the shipped behaviours pass" "$status"
for behaviour in behaviours/*.lua; do
    grep -q "$(basename "$behaviour")" tests/lua/*_test.lua || echo "not ok $behaviour has no test"
done

# ---- the test runner: failures and their messages ----
self=tests/lua/self

"$JOSTLE" test $self/passes_test.lua >"$work/passes" 2>&1
verdict "all tests of passes_test.lua pass" $?
[ "$(tail -1 "$work/passes")" = "$(grep -c '^test(' $self/passes_test.lua) passed, 0 failed" ]
verdict "they are counted" $?

# For each arrow in a file: a failure is reported at its line, with its text.
for file in $self/fails_test.lua $self/endless_test.lua; do
    name=$(basename "$file")
    "$JOSTLE" test "$file" >"$work/fails" 2>&1
    [ $? = 1 ]; verdict "$name: a failure is exit status 1" $?
    [ "$(tail -1 "$work/fails")" = "0 passed, $(grep -c '^test(' "$file") failed" ]
    verdict "$name: every test fails, and is counted" $?
    awk -v file="$file" -v name="$name" '
        FNR == NR { if (index($0, file ":") == 1) said[$0]; next }
        / --> / {
            wanted = substr($0, index($0, " --> ") + 5); place = file ":" FNR ": "; found = 0
            for (line in said)
                if (index(line, place) == 1 && index(line, wanted)) found = 1
            print (found ? "ok " : "not ok ") name ", line " FNR " fails with: " wanted
        }' "$work/fails" "$file"
done

cat >"$work/deep_test.lua" <<'END'
local function holds(a)
  equal(a, 2)
end
test("from a function", function()
  holds(1)
end)
END
"$JOSTLE" test "$work/deep_test.lua" >"$work/deep"
grep -q "^$work/deep_test.lua:2: 1 is not 2" "$work/deep" && grep -q "deep_test.lua:5" "$work/deep" &&
    ! grep -q '\.c:\|b0:\|\[C\]' "$work/deep"
verdict "a traceback ends at the test, without frames of the engine" $?

# ---- a failure says what agents wait for ----
cat >"$work/waits_test.lua" <<'END'
local pupil = [[
return machine { name = "m", start = "Sit", states = { Sit = { steer = hold, { to = "Go", when = heard "bell" },
  { to = "Nap", when = after(90) } }, Go = { steer = hold }, Nap = { steer = hold } } }
]]
local function class() return scene { groups = { people = { behaviour = pupil, at = { { 0, 0 }, { 3, 0 } } } } } end
test("reaches", function() class():reaches("Go", { within = 2 }) end)
test("equal", function()
  local s = class()
  s:run(1)
  truthy(s:why(1):find("agent 1 of group people", 1, true) and s:why({ to = "Nap" }):find("after(90)", 1, true))
  fails(function() s:why(2) end, "there is no agent 2")
  fails(function() s:why({ states = "Sit" }) end, "there is no option 'states'")
  equal(s:agent(0).state, "Go")
end)
END
"$JOSTLE" test "$work/waits_test.lua" >"$work/waits"
verdict "a failing test of agents is exit status 1" $(($? != 1))
awk '/^not ok reaches/ {at = 1} /^not ok equal/ {at = 2} /0 of 2 +heard\("bell"\) +nobody has called it so far/ {bell[at]++} /after\(90\)/ {nap[at]++}
    END {exit !(bell[1] == 1 && !nap[1] && bell[2] == 1 && nap[2] == 1)}' "$work/waits"
verdict "  and says what they wait for, of \`reaches\` what keeps them from that state" $?

# ---- files that cannot be run: exit status 3, with the place ----
refuse() { # NAME TEXT: checks that $work/NAME_test.lua is refused with a text
    "$JOSTLE" test "$work/$1_test.lua" >"$work/log" 2>&1
    [ $? = 3 ] && grep -qF "$work/$1_test.lua$2" "$work/log"
    status=$?
    verdict "$1: exit status 3" $status
    [ $status = 0 ] || cat "$work/log"
}
printf 'test("x", function()\n  equal(1, 1)\nend\n' >"$work/syntax_test.lua"
refuse syntax ":4: ')' expected"
printf 'local n = 1\nequal(n, 2)\n' >"$work/top_test.lua"
refuse top ":2: 1 is not 2"
printf '\nscene { groups = {} }\n' >"$work/outside_test.lua"
refuse outside ":2: a scene can only be made within a test"
printf 'while true do end\n' >"$work/endless_test.lua"
refuse endless ":1: it ran for too long"
printf 'local x = nope\ntest("x", function() truthy(true) end)\n' >"$work/word_test.lua"
refuse word ":1:11: unknown word 'nope'"
printf 'local e = _ENV\n' >"$work/env_test.lua"
refuse env ":1:11: '_ENV' cannot be used"
printf '\033Lua' >"$work/compiled_test.lua"
refuse compiled ": cannot load"
printf 'x = "\0"' >"$work/zero_test.lua"
refuse zero ":1:6: a text has no zero byte"
ln -s deep_test.lua "$work/link_test.lua"
refuse link ": cannot load"
refuse absent "' cannot be read: there is no such file"
rm "$work/link_test.lua"
# A file that cannot be run does not stop the others.
"$JOSTLE" test "$work/syntax_test.lua" $self/passes_test.lua "$work/deep_test.lua" >"$work/log" 2>&1
[ $? = 3 ] && tail -1 "$work/log" | grep -q '^[1-9][0-9]* passed, 1 failed$'
verdict "a file that cannot be run does not stop the others" $?

# ---- usage ----
"$JOSTLE" test --olny x >"$work/log" 2>&1
[ $? = 2 ] && grep -q 'olny' "$work/log"; verdict "an unknown option is exit status 2" $?
"$JOSTLE" test --only >"$work/log" 2>&1
[ $? = 2 ]; verdict "an option without its value is exit status 2" $?
"$JOSTLE" test --help | grep -q 'usage: jostle test'; verdict "test --help prints a usage" $?

# ---- --only, folders, --json ----
"$JOSTLE" test $self/fails_test.lua --only "faster_than" >"$work/log"
[ $? = 1 ] && [ "$(tail -1 "$work/log")" = "0 passed, 1 failed" ]; verdict "--only selects tests by name" $?
mkdir -p "$work/folder/inner"
for n in b a; do printf 'test("%s", function() equal(1, 1) end)\n' $n >"$work/folder/${n}_test.lua"; done
cp "$work/syntax_test.lua" "$work/folder/.hidden_test.lua"
cp "$work/syntax_test.lua" "$work/folder/helper.lua"
"$JOSTLE" test "$work/folder" >"$work/log"
[ $? = 0 ] && [ "$(sed 's/ (.*//' "$work/log" | tr '\n' ' ')" = "ok a ok b 2 passed, 0 failed " ]
verdict "a folder's tests run in order, without hidden and other files" $?
(cd "$work/folder" && mkdir tests && mv a_test.lua tests && "$OLDPWD/$JOSTLE" test >"$work/log" 2>&1 ||
    "$JOSTLE" test >"$work/log" 2>&1)
[ "$(sed 's/ (.*//' "$work/log" | tr '\n' ' ')" = "ok a 1 passed, 0 failed " ]
verdict "without a path the tests of the folder tests run" $?

"$JOSTLE" test --json $self/fails_test.lua $self/passes_test.lua >"$work/json"
[ $? = 1 ]; verdict "--json has the same exit status" $?
json() { sqlite3 :memory: "select count(*) from json_each(readfile('$work/json')) where $1"; }
[ "$(json "json_extract(value, '\$.passed') = 1")" = "$(grep -c '^test(' $self/passes_test.lua)" ] &&
    [ "$(json "json_extract(value, '\$.passed') = 0")" = "$(grep -c '^test(' $self/fails_test.lua)" ] &&
    [ "$(json "json_extract(value, '\$.message') like '%2 is not 3%' and json_extract(value, '\$.name') = 'equal' and
        json_extract(value, '\$.file') = '$self/fails_test.lua' and json_extract(value, '\$.line') = $(
            grep -n '> 2 is not 3' $self/fails_test.lua | cut -d: -f1)")" = 1 ]
verdict "--json is one array of results with their positions" $?

# ---- the same figures as a run ----
cat >"$work/hash_test.lua" <<END
test("hash", function()
  local s = scene("$PWD/scenes/running-through.yaml")
  s:run(10)
  equal(s:hash(), "$(hash_of "$JOSTLE" scenes/running-through.yaml --for 10)")
end)
END
"$JOSTLE" test "$work/hash_test.lua" >"$work/log"
verdict "a scene in a test and a run of it end with the same hash" $?
