#!/bin/bash
# What a call of a plain function of a behaviour costs: processor time of runs that differ in that function alone,
# over the number of calls. With OTHER=path/to/jostle, of both programs in turn, and their ratio. ROUNDS may be set.
# Prints the least and the median of the rounds, ns; nothing passes or fails.
set -eu
cd "$(dirname "$0")/../.."
B=${B:-build/release}
ROUNDS=${ROUNDS:-7}
programs=("$B/jostle" ${OTHER:-})
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
side=40 steps=400 # 1,600 people, 1 m apart, who stand: ten neighbours each
cases="still steer when enter memory upvalues neighbours flock"

machine() { # CASE: keys of the machine and of its states
    case $1 in
    still) echo 'A = { steer = hold }' ;;
    steer) echo 'A = { steer = function(me) return 0, 0 end }' ;;
    when) echo 'A = { steer = hold, { to = "A", when = function(me) return me.x > 1e9 end } }' ;;
    enter) echo 'A = { steer = hold, on_enter = function(me) me.n = 1 end, { to = "A" } }' ;;
    memory) echo 'A = { steer = function(me) me.n = me.n + 1 return 0, 0 end }' ;;
    upvalues) echo 'A = { steer = function(me) return floor(0.5), low * high end }' ;;
    neighbours) echo 'A = { steer = function(me) return 0 * #me.neighbours, 0 end }' ;;
    flock)
        echo 'A = { steer = function(me)
            local n, x, y, vx, vy = me.neighbours, 0, 0, 0, 0
            for i = 1, #n do
                local o = n[i]
                x, y, vx, vy = x + o.x, y + o.y, vx + o.vx, vy + o.vy
            end
            return 1e-9 * (x + vx), 1e-9 * (y + vy)
        end }' ;;
    esac
}
for name in $cases; do
    {
        echo 'local mine, floor, low, high = memory { n = 0 }, math.floor, 0, 1'
        echo 'return machine { name = "timed", start = "A", defaults = { perception = 4, neighbours = 10, speed = 0 },'
        echo "states = { $(machine $name) } }"
    } >"$work/$name.lua"
    cat >"$work/$name.yaml" <<SCENE
jostle: 1
places: {floor: {polygon: [[0, 0], [$side, 0], [$side, $side], [0, $side]]}}
groups: {people: {behaviour: $name.lua, count: $((side * side)), fill: grid, spacing: 1, in: floor}}
SCENE
done
TIMEFORMAT=%U
for ((round = 0; round < ROUNDS; round++)); do
    for name in $cases; do
        for ((p = 0; p < ${#programs[@]}; p++)); do
            took=$({ time "${programs[p]}" run "$work/$name.yaml" --steps $steps --threads 1 --quiet --no-mods >"$work/said" 2>&1; } 2>&1) ||
                { cat "$work/said" >&2; exit 1; }
            echo "$name $p $took"
        done
    done
done >"$work/times"
awk -v calls=$((side * side * steps)) '
    { n[$1, $2]++; t[$1, $2, n[$1, $2]] = $3; if ($2 > most) most = $2; if (!($1 in seen)) { seen[$1]; order[++count] = $1 } }
    function sorted(key, p,    i, j, v) { # times of a case, ascending
        for (i = 2; i <= n[key, p]; i++)
            for (j = i; j > 1 && t[key, p, j] < t[key, p, j - 1]; j--) {
                v = t[key, p, j]; t[key, p, j] = t[key, p, j - 1]; t[key, p, j - 1] = v
            }
    }
    END {
        for (c = 1; c <= count; c++) for (p = 0; p <= most; p++) sorted(order[c], p)
        print "ns a call, besides the step itself (least, median of " n["still", 0] " rounds)"
        for (c = 2; c <= count; c++) {
            line = sprintf("%-12s", order[c])
            for (p = 0; p <= most; p++) {
                m = int((n[order[c], p] + 1) / 2)
                least[p] = (t[order[c], p, 1] - t["still", p, 1]) / calls * 1e9
                line = line sprintf("%9.0f %7.0f", least[p], (t[order[c], p, m] - t["still", p, m]) / calls * 1e9)
            }
            print line (most ? sprintf("   ratio %.2f", least[0] / least[1]) : "")
        }
    }' "$work/times"
