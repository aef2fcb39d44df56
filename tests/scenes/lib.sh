# Functions that the suites in this folder share. Each case prints "ok NAME" or "not ok NAME"; a name that begins with
# two spaces continues the case above it.
B=${B:-build/release}
JOSTLE=${JOSTLE:-$B/jostle}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export XDG_DATA_HOME=$work/data XDG_CONFIG_HOME=$work/config # only mods of the source tree, none of them turned on

verdict() { # NAME STATUS
    if [ "$2" = 0 ]; then echo "ok $1"; else echo "not ok $1"; fi
}
# figure NAME < summary: prints a top-level number or string of a summary
figure() { sed -n "s/^ \"$1\": \"\{0,1\}\([^\",]*\)\"\{0,1\},\{0,1\}$/\1/p"; }
# hash_of PROGRAM SCENE ARGS...: runs a scene and prints the hash of its final state
hash_of() {
    local program=$1 scene=$2; shift 2
    "$program" run "$scene" --quiet --summary - "$@" 2>/dev/null | figure hash
}
# same_hash NAME HASH...: checks that all hashes are equal and not empty
same_hash() {
    local name=$1 first=$2 h; shift
    for h in "$@"; do
        if [ -z "$h" ] || [ "$h" != "$first" ]; then echo "not ok $name: $*"; return; fi
    done
    echo "ok $name"
}
# between NAME VALUE LOW HIGH: checks that a number is from LOW to HIGH
between() {
    awk -v v="$2" -v a="$3" -v b="$4" 'BEGIN {exit !(v != "" && v >= a && v <= b)}'
    if [ $? = 0 ]; then echo "ok $1 ($2)"; else echo "not ok $1: $2 is not within $3 to $4"; fi
}
# outlined NAME FOLDER FILE [--no-ranges]: compares the outline of a report in FOLDER (sections, titles, axes; outline.py) with
# tests/data/outlines/FILE.txt. To change it, look at the page and its pictures, then run the test with OUTLINES=write.
outlined() {
    python3 tests/scenes/outline.py "$2" ${4-} >"$work/outline"
    [ "${OUTLINES-}" = write ] && cp "$work/outline" "tests/data/outlines/$3.txt"
    diff "tests/data/outlines/$3.txt" "$work/outline" >"$work/differences"
    local differs=$?
    [ $differs = 0 ] || head -20 "$work/differences"
    verdict "$1" $differs
}
# expect NAME STATUS TEXT COMMAND...: checks a command's exit status, and that its output, kept in $work/out, has a text
expect() {
    local name=$1 status=$2 text=$3; shift 3
    timeout 300 "$@" >"$work/out" 2>&1 </dev/null
    local got=$?
    if [ $got = "$status" ] && grep -qF -- "$text" "$work/out"; then echo "ok $name"; else
        echo "not ok $name: status $got, wanted $status and '$text'"; head -5 "$work/out"; fi
}
