# Quick tests of standards (reproduce --standards), and their page; which gates behaviours see.
. tests/scenes/lib.sh
says() { # NAME STATUS TEXT COMMAND...: the exit status, and a text in the output
    local name=$1 status=$2 text=$3; shift 3
    "$@" >"$work/out" 2>&1 </dev/null
    [ $? = "$status" ] && grep -qF -- "$text" "$work/out"
    verdict "$name" $?
}

quick="R5 R12b R12c I1 I5 I6 I10 N1.1 N2.4 N2.9 N2.10 N3.3 N4.1"
says "the quick tests of standards pass" 0 "13 of 13 claims in band" "$JOSTLE" reproduce $quick --standards --quick --quiet --out "$work/rep"
[ "$(grep -c '^N4.1 ' "$work/out")" = 1 ]; verdict "each test is listed once" $?
page="$work/rep/standards.html"
grep -q 'plan-N4.1.png' "$page" && [ -s "$work/rep/plan-N4.1.png" ]; verdict "each test has its plan" $?
grep -q '<td>IMO MSC.1/Circ.1533<td class=n>4<td class=n>4<td class=n>0' "$page"; verdict "the tests of a standard are counted" $?
grep -q 'Wrong input, with which the test must fail: the first exit is shut only when all have left' "$page" && grep -q '<td class=n>20, fails' "$page"; verdict "each test has its wrong input" $?
grep -q 'Verdicts of quick runs are not the published ones. Cut to fewer seeds or shorter runs: [^<]*R5' "$page"; verdict "the page says which quick tests were cut" $?
grep -q '2.5 and 2.6 (smoke)' "$page"; verdict "tests that are not covered are named" $?
says "a group runs its claims" 0 "N2.10  NIST 2.10" "$JOSTLE" reproduce nist --list
says "standards runs the tests of all standards" 0 "R16  RiMEA 16" "$JOSTLE" reproduce --standards --list
"$JOSTLE" reproduce --standards --list 2>/dev/null | grep -q '^B1 '; verdict "and no others" $((1 - $?))

# Who cannot see that a door is shut does not know it: a screen stands between the two in the west and their door.
mkdir -p "$work/scenes"
cp scenes/exit-lost.yaml scenes/two-exits.yaml "$work/scenes"
cp -r behaviours "$work"; cp scripts/crowd.lua "$work/behaviours"
cat >"$work/scenes/screen.yaml" <<'END'
jostle: 1
include: exit-lost.yaml
duration: 4
walls:
  - {line: [[0, 5.5], [0, 0], [20, 0], [20, 5.5]]}
  - {line: [[0, 6.5], [0, 12], [20, 12], [20, 6.5]]}
  - {line: [[0, 5.5], [-5, 3], [-5, 9], [0, 6.5]]}
  - {line: [[20, 5.5], [25, 3], [25, 9], [20, 6.5]]}
  - {line: [[0, 5.5], [0, 6.5]], name: west, open: true}
  - {line: [[20, 5.5], [20, 6.5]], name: east, open: true}
  - {line: [[2, 3], [2, 9]]}
groups:
  people: {count: 6, spacing: 0.8, in: middle, set: {premovement: 0}}
places:
  middle: {polygon: [[8, 4], [12, 4], [12, 8], [8, 8]]}
END
seen() { "$JOSTLE" run "$1" --for "$2" --quiet --summary - 2>/dev/null | tr '\n' ' ' | sed -n 's/.*"leaver": {[^}]*"ToSecond": \([0-9]*\).*/\1/p'; }
between "people behind a screen do not see the shut door, and keep to it" "$(seen "$work/scenes/screen.yaml" 3)" 0 0
sed -i '/\[\[2, 3\], \[2, 9\]\]/d' "$work/scenes/screen.yaml"
between "people who see the shut door turn to the other exit" "$(seen "$work/scenes/screen.yaml" 3)" 6 7
