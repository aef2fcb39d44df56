# The shipped scenes show what they promise, and are equal on one thread and two.
. tests/scenes/lib.sh
summary() { "$JOSTLE" run "scenes/$1.yaml" --quiet --summary - "${@:2}" 2>/dev/null; }
# people MACHINE STATE < summary: how many are in it
people() { tr '\n' ' ' | sed -n "s/.*\"$1\": {[^}]*\"$2\": \([0-9]*\).*/\1/p"; }
event() { sed -n "s/.*\"$1\": \([0-9]*\).*/\1/p"; }
summary corridor >"$work/s"
between "corridor: nobody is lost" "$(figure agents <"$work/s")" 160 160
between "corridor: people turn round at the ends" "$(event transitions <"$work/s")" 120 400
summary counter >"$work/s"
between "counter: all 20 are served and gone" "$(event removed <"$work/s")" 20 20
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
    between "hurried-polite: the hurried one is faster, seed $seed" "$(awk -v a="$hurried" -v b="${polite:-30}" 'BEGIN {print b - a}')" 3 30
done
summary catch >"$work/s"
between "catch: balls are taken and thrown" "$(event throws <"$work/s")" 20 500
between "catch: and hit" "$(event hits <"$work/s")" 3 500
summary station >"$work/s"
between "station: all 40 ride, as standers" "$(people stander Stand <"$work/s")" 40 40
between "station: nobody of the strollers boards" "$(($(people wanderer Walk <"$work/s") + $(people wanderer Stay <"$work/s")))" 15 15
for scene in corridor counter tour families evacuation hurried-polite catch station; do
    same_hash "$scene, one thread and two" "$(hash_of "$JOSTLE" "scenes/$scene.yaml" --for 15)" "$(hash_of "$JOSTLE" "scenes/$scene.yaml" --for 15 --threads 2)"
done
exit 0
