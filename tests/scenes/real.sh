# Measures recordings of real crowds by probes, and compares the figures with published ones. The recordings are not part
# of the project: JOSTLE_REAL_DATA names their folder.
. tests/scenes/lib.sh
data=${JOSTLE_REAL_DATA:-}
if [ -z "$data" ]; then echo "ok real crowds: skipped, JOSTLE_REAL_DATA names no folder"; exit 0; fi
if [ ! -d "$data" ]; then echo "not ok real crowds: there is no folder '$data' (JOSTLE_REAL_DATA)"; exit 1; fi

# measure SCENE RECORDING [OPTION...]: writes the summary to $work/out, CSV files to $work/files
measure() {
    local scene=$1 recording=$2; shift 2
    rm -rf "$work/files"
    "$JOSTLE" report "$data/$recording" --scene "tests/data/$scene" --summary "$work/out" --out "$work/files" "$@" >"$work/said" 2>&1 ||
        { echo "not ok report on $recording"; head -5 "$work/said"; }
}
# of PROBE FIGURE: prints a figure of the summary
of() { sed -n "s/^  \"$1\": {.*\"$2\": \([^,}]*\).*/\1/p" "$work/out"; }

measure bottleneck.yaml bottleneck/wuppertal_040_door050.txt
between "door: everyone passes" "$(of door passages)" 75 75
between "door: flow of the middle 60 %, 1/s" "$(of door flow)" 1.12 1.18
between "door: cleared, s" "$(of door duration)" 64 65
between "door: median lapse, s" "$(of door lapse_median)" 0.82 0.86
between "door: longest lapse, s" "$(of door lapse_max)" 2.4 2.6
# In a square of 0.8 m, half a metre before the door.
between "door: density in front, 1/m2" "$(of front density)" 6.0 6.4
between "door: density in front, 90 %, 1/m2" "$(of front density_p90)" 8.3 8.8

corridor() { # NAME, then least and greatest flow per metre, density and speed
    measure "corridor-$1.yaml" "corridor/uo-$1.txt" --fps 16 --unit cm
    between "corridor $1: flow, 1/(m s)" "$(of line specific_flow)" "$2" "$3"
    between "corridor $1: density, 1/m2" "$(of middle density)" "$4" "$5"
    between "corridor $1: speed, m/s" "$(of middle speed)" "$6" "$7"
}
corridor 100-180-180 1.30 1.46 1.08 1.20 1.15 1.27
corridor 180-180-120 1.26 1.40 1.94 2.14 0.63 0.71
corridor 180-180-070 0.90 1.00 2.91 3.21 0.32 0.37

measure single_file.yaml single_file/n34_cam2.csv --fps 25 --unit m
between "single file: people a metre" "$(of straight density_classical)" 1.15 1.30
between "single file: Voronoi agrees" "$(of straight density)" 1.10 1.30
between "single file: speed there, m/s" "$(of straight speed)" 0.42 0.53 # .58 at 1.11, .42 at 1.28

measure push_row.yaml push_row/free_head_trajectories.csv
between "push: speed of its front, m/s" "$(of row front_speed)" 2.4 2.75
n=1
for peak in 0.44 0.50 0.65 0.70 0.54; do
    n=$((n + 1))
    between "push: greatest displacement of person $((n - 1)), m" "$(sed -n "${n}p" "$work/files/row.csv" | cut -d, -f7)" \
        "$(awk "BEGIN {print $peak - 0.015}")" "$(awk "BEGIN {print $peak + 0.015}")"
done

# Scenes of recorded crowds: their probes, applied to the recordings, give the values of their claims.
recorded() { # SCENE RECORDING [OPTION...], then PROBE FIGURE LOW HIGH on each line of the input
    local scene=$1 probe figure low high
    measure "../../scenes/$scene.yaml" "${@:2}"
    while read -r probe figure low high; do
        between "$scene: $figure of $probe" "$(of "$probe" "$figure")" "$low" "$high"
    done
}
recorded door-050 bottleneck/wuppertal_040_door050.txt --unit m <<'FIGURES'
door flow 1.14 1.16
door lapse_max 2.4 2.6
front density 6.7 6.8
square density 6.0 6.4
square density_p90 8.3 8.8
front speed 0.125 0.135
FIGURES
recorded opening-300 bottleneck/ao_300.txt --unit m <<'FIGURES'
line flow 7.17 7.20
opening density 3.39 3.43
opening speed 0.715 0.725
front density 5.30 5.34
front speed 0.376 0.386
FIGURES
recorded door-080 bottleneck/pupils_080.txt --unit m <<'FIGURES'
line flow 2.95 2.99
front density 4.70 4.78
front speed 0.338 0.348
FIGURES
recorded corner-300 corner/corner_300.txt --unit m <<'FIGURES'
line flow 3.17 3.19
before density 0.98 1.00
before speed 1.09 1.11
corner density 0.57 0.59
corner speed 1.11 1.13
after density 0.96 0.98
after speed 1.12 1.14
FIGURES
widths() { # WIDTHS, then least and greatest specific flow, density and speed
    recorded "corridor-uo-$1" "corridor/uo-$1.txt" --fps 16 --unit cm <<<"line specific_flow $2 $3
middle density $4 $5
middle speed $6 $7"
}
widths 100-180-180 1.31 1.33 1.11 1.13 1.20 1.22
widths 180-180-120 1.33 1.35 2.03 2.05 0.67 0.69
widths 180-180-070 0.94 0.96 2.97 2.99 0.365 0.375
widths 050-180-180 0.65 0.67 0.52 0.54 1.34 1.36
widths 180-180-095 1.01 1.03 2.35 2.37 0.45 0.46
widths 240-240-240 1.64 1.66 1.83 1.85 0.91 0.93
widths 300-300-300 1.73 1.75 1.81 1.83 0.96 0.98
recorded corridor-bo-360-160-160 bidirectional/bo-360-160-160.txt --fps 16 --unit cm <<'FIGURES'
southward flow 2.54 2.58
northward flow 2.03 2.07
middle density 1.89 1.91
middle speed 0.66 0.68
FIGURES
recorded corridor-bot-360-250-250 bidirectional/bot-360-250-250.txt --fps 16 --unit cm <<'FIGURES'
southward flow 2.33 2.37
northward flow 2.18 2.22
middle density 2.58 2.60
middle speed 0.54 0.56
FIGURES
