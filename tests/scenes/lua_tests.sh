# Tests of the shipped behaviours, and of the program that runs them.
. tests/scenes/lib.sh

"$JOSTLE" test tests/lua >"$work/shipped" 2>&1
status=$?
grep -E '^(ok|not ok) ' "$work/shipped" | sed 's/ ([0-9.]* s simulated in [0-9.]* s)$//'
[ "$status" = 0 ] || cat "$work/shipped"
verdict "the tests of the shipped behaviours end well" "$status"
for behaviour in behaviours/*.lua; do
    grep -q "$(basename "$behaviour")" tests/lua/*_test.lua || echo "not ok $behaviour has no test"
done
