# Nobody who wants to get on stands for ever: in no shipped scene where people walk by the walking law has anybody come
# no farther than 0.25 m for a minute.
. tests/scenes/lib.sh
MOST=60    # s
LOOKED=100 # s of a scene at most

# stood SCENE SECONDS: s of who stood the longest
stood() { "$JOSTLE" run "$1" --for "$2" --quiet --summary - 2>/dev/null | tr '\n' ' ' | sed -n 's/.*"stood_longest": { *"s": \([0-9.]*\).*/\1/p'; }
# by_law BEHAVIOUR: whether its people keep a time gap
by_law() { grep -q 'time_gap = crowd.time_gap' "behaviours/$1.lua" 2>/dev/null; }

looked=0
for scene in scenes/*.yaml; do
    for behaviour in $(sed -n 's/.*behaviour: *\([a-z-]*\).*/\1/p' "$scene" | sort -u); do
        by_law "$behaviour" || continue
        seconds=$(sed -n 's/^duration: *\([0-9]*\).*/\1/p' "$scene")
        [ "$seconds" -le $LOOKED ] || seconds=$LOOKED
        name=$(basename "$scene" .yaml) most=$MOST
        case $name in
        arena | rimea-09 | imo-09) most=90 ;; # hundreds before each exit, who wait for their turn
        rimea-11) most=100 ;;                 # a thousand before two
        counter-rooms) most=100 ;;            # two hundred against each other in 2 m, who jam (claims I8 and N2.8)
        esac
        between "$name: nobody stands for $most s, of $seconds" "$(stood "$scene" "$seconds")" 0 $most
        looked=$((looked + 1))
        break
    done
done
between "scenes where people walk by the walking law" $looked 20 1000

# Somebody who walks straight into a blind alley is told of.
cat >"$work/wall.yaml" <<'END'
jostle: 1
duration: 90
places:
  here: {point: [0, 0], radius: 0.5}
  there: {point: [9, 0], radius: 0.5}
walls:
  - {line: [[1, 0.3], [4, 0.3], [4, -0.3], [1, -0.3]]}
groups:
  one: {behaviour: pedestrian.lua, at: [[0, 0]], set: {goal: there, home: here}}
END
between "who stands in a blind alley is told of" "$(stood "$work/wall.yaml" 90)" 12 90 # who turns about in it starts anew
cat >"$work/held.yaml" <<'END'
jostle: 1
duration: 90
groups:
  one: {behaviour: stander.lua, at: [[0, 0]]}
END
between "who wants to stand is not" "$(stood "$work/held.yaml" 90)" 0 0
