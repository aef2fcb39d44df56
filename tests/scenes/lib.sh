# What the scene tests share. Prints "ok NAME" or "not ok NAME".
B=${B:-build/release}
JOSTLE=${JOSTLE:-$B/jostle}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export XDG_DATA_HOME=$work/data XDG_CONFIG_HOME=$work/config # no mods but those of the tree, and none on

verdict() { # NAME STATUS
    if [ "$2" = 0 ]; then echo "ok $1"; else echo "not ok $1"; fi
}
# figure NAME < summary: a top-level number or string of a summary
figure() { sed -n "s/^ \"$1\": \"\{0,1\}\([^\",]*\)\"\{0,1\},\{0,1\}$/\1/p"; }
# hash_of PROGRAM SCENE ARGS...: the state's hash at the end of a run
hash_of() {
    local program=$1 scene=$2; shift 2
    "$program" run "$scene" --quiet --summary - "$@" 2>/dev/null | figure hash
}
# same_hash NAME HASH...: all equal and not empty. The one helper that compares runs.
same_hash() {
    local name=$1 first=$2 h; shift
    for h in "$@"; do
        if [ -z "$h" ] || [ "$h" != "$first" ]; then echo "not ok $name: $*"; return; fi
    done
    echo "ok $name"
}
# between NAME VALUE LOW HIGH
between() {
    awk -v v="$2" -v a="$3" -v b="$4" 'BEGIN {exit !(v != "" && v >= a && v <= b)}'
    if [ $? = 0 ]; then echo "ok $1 ($2)"; else echo "not ok $1: $2 is not within $3 to $4"; fi
}
# outlined NAME FOLDER FILE [--no-ranges]: what a report says of itself (outline.py) is what tests/data/outlines has; where
# that is to change, look at the page and its pictures, and run the test with OUTLINES=write
outlined() {
    python3 tests/scenes/outline.py "$2" ${4-} >"$work/outline"
    [ "${OUTLINES-}" = write ] && cp "$work/outline" "tests/data/outlines/$3.txt"
    diff "tests/data/outlines/$3.txt" "$work/outline" >"$work/differences"
    local differs=$?
    [ $differs = 0 ] || head -20 "$work/differences"
    verdict "$1" $differs
}
# NAME STATUS TEXT COMMAND...: the exit status, and a text in what it writes, which is left in $work/out.
expect() {
    local name=$1 status=$2 text=$3; shift 3
    timeout 300 "$@" >"$work/out" 2>&1 </dev/null
    local got=$?
    if [ $got = "$status" ] && grep -qF -- "$text" "$work/out"; then echo "ok $name"; else
        echo "not ok $name: status $got, wanted $status and '$text'"; head -5 "$work/out"; fi
}
