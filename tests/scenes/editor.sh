# Definitions for lua-language-server (scripts/editor/jostle.lua), checked by a Lua parser and a reader of annotations:
# each word, key, parameter, field of `me` and function of tests is there with a type. Needs lua5.4.
. tests/scenes/lib.sh
"$JOSTLE" reference lua-ls >"$work/jostle.lua" 2>"$work/said"; verdict "definitions are printed" $?
"$JOSTLE" reference behaviours >"$work/page.md"; verdict "the page of words is printed" $?
checked() { lua5.4 tests/scenes/check_definitions.lua "$1" "$work/page.md" >"$work/out" 2>&1; }
checked "$work/jostle.lua"; status=$?
[ $status = 0 ] || head -20 "$work/out"
verdict "every word and key has its definition, and every annotation can be read" $status
found() { # NAME SED-SCRIPT TEXT: definitions that are changed so are found wrong, for this reason
    sed -E "$2" "$work/jostle.lua" >"$work/broken.lua"
    cmp -s "$work/broken.lua" "$work/jostle.lua" && { echo "not ok $1: nothing was changed"; return; }
    ! checked "$work/broken.lua" && grep -qF -- "$3" "$work/out"; verdict "$1" $?
}
found "a missing word is found" '/^function near\(/,+1d' "word 'near' is missing"
found "a missing parameter" '/^---@field push_reach/d' "parameter 'push_reach' is missing in Parameters"
found "a missing key of a state" '/^---@field approach/d' "key 'approach' is missing in State"
found "a missing field of me" '/^---@field time_in_state number/d' "field of me 'time_in_state' is missing in Me"
found "a missing method of tests" '/^function Scene:reaches/d' "method 'reaches' of tests is missing"
found "a missing filter" '/^function Target:within/d' "filter 'within' is missing"
found "a key without a type" 's/^(---@field lasts\?) [^ ]+/\1 any/' "key 'lasts' of State has no type"
found "a class that is not there" 's/@return jostle.Steering/@return jostle.Stering/' "there is no class jostle.Stering"
found "a parameter of another name" 's/^---@param metres/---@param meters/' "is 'metres', annotated as 'meters'"
found "an annotation that cannot be read" 's/^---@class jostle.Kick$/---@class/' "cannot be read: ---@class"
found "a type that cannot be read" 's/table<string, jostle.State>/table<string, jostle.State/' "cannot be read: ---@field states"
found "an operator that there is not" 's/@operator unm/@operator len/' "cannot be read: ---@operator len"
found "what is no Lua" 's/^function clamp\((.*)\) end/function clamp(\1)/' "it is no Lua"

# The functions of tests are those that tests have.
{
    echo 'test("all of them", function()'
    echo '  local s = scene { groups = { g = { behaviour = "return machine { name = \"m\", start = \"A\", states = { A = {} } }", at = { { 0, 0 } } } } }'
    sed -n 's/^| `\([a-z]*\)([^`]*` | [a-z].*/  equal(type(\1), "function")/p' <(sed -n '/^## Tests/,$p' "$work/page.md")
    sed -n 's/^| `s:\([a-z_]*\)(.*/  equal(type(s.\1), "function")/p' "$work/page.md"
    echo 'end)'
} >"$work/words_test.lua"
[ "$(grep -c equal "$work/words_test.lua")" -ge 20 ]; verdict "functions of tests are on the page" $?
expect "  and tests have them" 0 "1 passed, 0 failed" "$JOSTLE" test "$work/words_test.lua"
luacheck --quiet --no-color --std lua54 --no-max-line-length --no-global --no-unused-args --ignore 241 -- "$work/jostle.lua" >"$work/out" 2>&1; verdict "luacheck reads the definitions" $?
