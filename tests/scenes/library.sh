# Shipped scenes: figures of their summaries.
. tests/scenes/lib.sh
summary() { "$JOSTLE" run "scenes/$1.yaml" --quiet --summary - "${@:2}" 2>/dev/null; }
# people MACHINE STATE < summary: prints the number of people in a state
people() { tr '\n' ' ' | sed -n "s/.*\"$1\": {[^}]*\"$2\": \([0-9]*\).*/\1/p"; }
event() { sed -n "s/.*\"$1\": \([0-9][0-9]*\).*/\1/p"; }
summary corridor >"$work/s"
between "corridor: nobody is lost" "$(figure agents <"$work/s")" 160 160
between "corridor: people turn round at the ends" "$(event transitions <"$work/s")" 120 400
summary counter >"$work/s"
between "counter: all 20 are served and leave" "$(event removed <"$work/s")" 20 20
summary tour >"$work/s"
between "tour: the guide tells stories, all twelve listen at times" "$(event transitions <"$work/s")" 100 2000
between "tour: nobody is lost in the end" "$(people tourist Lost <"$work/s")" 0 1
summary families >"$work/s"
between "families: all 60 arrive" "$(event removed <"$work/s")" 60 60
for seed in 1 2 3; do
    summary evacuation --seed $seed >"$work/s"
    between "evacuation: nobody is left, seed $seed" "$(figure agents <"$work/s")" 0 0
done
arrival() { "$JOSTLE" run scenes/hurried-polite.yaml --quiet --seed "$1" --trace "$2" 2>&1 | sed -n 's/^t=\([0-9.]*\) .*-> Arrived.*/\1/p'; }
for seed in 1 2; do
    hurried=$(arrival $seed 44) polite=$(arrival $seed 45)
    between "hurried-polite: the hurried person is faster by, s, seed $seed" "$(awk -v a="$hurried" -v b="${polite:-30}" 'BEGIN {print b - a}')" 2 30
done
# Dodge-ball without a person who drives: the time between two kicks stays below a minute.
for seed in 1 2 3; do
    "$JOSTLE" run scenes/dodgeball.yaml --for 600 --seed $seed --data "$work/game" --quiet
    between "dodge-ball goes on for ten minutes, seed $seed: longest time without a kick, s" \
        "$(awk -F, '$2 == "kicks" {d = $1 - last; if (d > most) most = d; last = $1} END {d = 600 - last; print (d > most ? d : most)}' "$work/game/actions.csv")" 0.1 60
done
summary catch >"$work/s"
between "catch: balls are taken and thrown" "$(event throws <"$work/s")" 20 500
between "catch: balls hit people" "$(event hits <"$work/s")" 3 500
summary station >"$work/s"
between "station: all 40 board and stand" "$(people stander Stand <"$work/s")" 40 40
between "station: no wanderer boards" "$(($(people wanderer Walk <"$work/s") + $(people wanderer Stay <"$work/s")))" 15 15
# of PROBE FIGURE < summary: prints a figure of a probe
of() { sed -n "s/^  \"$1\": {.*\"$2\": \([-0-9.e+]*\).*/\1/p"; }
summary bottleneck >"$work/s"
between "bottleneck: all 180 pass a width of 1.2 m" "$(of door passages <"$work/s")" 180 180
between "bottleneck: 2.23 a second, within a fifth" "$(of door flow <"$work/s")" 1.78 2.68
between "bottleneck: nobody is left at the end" "$(figure agents <"$work/s")" 0 0
summary single-file >"$work/s"
between "single file: speed at 30 people in 26.84 m" "$(of ring speed <"$work/s")" 0.46 0.7
summary ring >"$work/s"
between "ring corridor: speed at 1.71 people a square metre" "$(of middle speed <"$work/s")" 0.42 0.7
summary corridor-uo-180-180-070 >"$work/s"
between "corridor with entrance and exit: all 148 come in and leave" "$(figure agents <"$work/s")" 0 0
summary bidirectional >"$work/s"
between "bidirectional: order of the lanes" "$(of lanes order <"$work/s")" 0.75 1
between "bidirectional: speed, m/s" "$(of lanes speed <"$work/s")" 0.75 1.25
summary rimea-09 >"$work/s"
between "RiMEA 9: a thousand leave" "$(event removed <"$work/s")" 1000 1000
summary rimea-10 >"$work/s"
between "RiMEA 10: nobody takes the wrong exit" "$(of main_wrong passages <"$work/s")$(of secondary_wrong passages <"$work/s")" 0 0
between "RiMEA 10: all 23 leave" "$(event removed <"$work/s")" 23 23
summary rimea-11 --set groups.people.count=300 >"$work/s"
between "RiMEA 11: number of 300 people who take the nearer door" "$(of near forward <"$work/s")" 120 270
between "RiMEA 11, of 300 people: all leave" "$(event removed <"$work/s")" 300 300
for scene in rimea-15 rimea-15-straight; do
    summary $scene --set groups.people.count=100 >"$work/s"
    between "$scene, of 100 people: all arrive" "$(event removed <"$work/s")" 100 100
done
