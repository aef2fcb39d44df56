#!/bin/bash
# Compares the instructions per agent and step, counted by callgrind for scalar and AVX2 kernels (it does not support
# AVX-512), with tests/bench/instructions.csv. Unlike times, they are the same in every run. More than MARGIN per cent
# above the table fails. `tests/scenes/instructions.sh --write` (make bench-instructions) counts again and replaces the
# table, for deliberate changes. The computation of distance fields is left out.
cd "$(dirname "$0")/../.."
. tests/scenes/lib.sh
table=tests/bench/instructions.csv
MARGIN=4
# Prints NAME, STEPS, instruction sets, scene and settings of each case. In all, the number of people is constant.
cases() {
    cat <<'CASES'
dodgeball 100 avx2 scenes/dodgeball.yaml
running-through 40 scalar,avx2 scenes/running-through.yaml
circle 20 scalar,avx2 scenes/circle.yaml --set groups.crossing.count=300
counterflow 10 scalar,avx2 scenes/counterflow.yaml --set bounds.1.0=4 --set places.field.polygon.1.0=4 --set places.field.polygon.2.0=4 --set places.between.polygon.1.0=4 --set places.between.polygon.2.0=4 --set groups.eastward.count=288 --set groups.westward.count=288
evacuation 20 scalar,avx2 scenes/evacuation.yaml
tawaf 10 avx2 scenes/tawaf.yaml --set groups.pilgrims.count=1000 --set sources.0.keep=1000
CASES
}
# Counts of different compilers cannot be compared.
compiler=$(readelf -p .comment "$JOSTLE" | sed -n 's/^ *\[[^]]*\] *//p' | tr -d ',\r' | sort -u | paste -s -d ';')

count() { # ISA STEPS SCENE...: prints instructions per agent and step
    local isa=$1 steps=$2
    shift 2
    valgrind --tool=callgrind --callgrind-out-file=/dev/null --collect-atstart=no --toggle-collect=jox_world_step \
        --toggle-collect=jox_routes_update "$JOSTLE" run "$@" --isa "$isa" --steps "$steps" --threads 1 --no-mods --trusted \
        --quiet --summary "$work/summary" 2>"$work/said" </dev/null || return 1
    awk -v steps="$steps" 'FNR == NR {if ($1 == "\"agents\":") agents = $2 + 0; next}
        / Collected : / {if (agents) printf "%.0f\n", $4 / steps / agents}' "$work/summary" "$work/said"
}
all() { # prints the table
    echo "scene,isa,instructions_per_agent_step,compiler"
    cases | while read -r name steps isas arguments; do
        for isa in ${isas//,/ }; do
            [ "$isa" = scalar ] || grep -qw "$isa" /proc/cpuinfo || continue
            echo "$name,$isa,$(count "$isa" "$steps" $arguments),$compiler"
        done
    done
}
all >"$work/counted"
if [ "${1-}" = --write ]; then
    ! grep -q ',,' "$work/counted" || { cat "$work/said"; exit 1; }
    cat "$work/counted"
    cp "$work/counted" "$table"
    exit
fi
if ! cut -d , -f 4 "$table" | grep -qxF "$compiler"; then
    ! grep -q ',,' "$work/counted"
    verdict "instructions are counted, but not compared: the table is of another compiler than $compiler" $?
    exit
fi
while IFS=, read -r name isa figure by; do
    [ "$isa" != isa ] || continue
    expected=$(awk -F , -v name="$name" -v isa="$isa" '$1 == name && $2 == isa {print $3}' "$table")
    awk -v f="$figure" -v e="$expected" -v m=$MARGIN 'BEGIN {exit !(f > 0 && e > 0 && f <= e * (1 + m / 100))}'
    verdict "$name $isa: $figure instructions per agent and step, ${expected:-none} in the table" $?
done <"$work/counted"
