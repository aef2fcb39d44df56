# Nobody who wants to get on stands for ever: in no shipped scene with the walking law does a person move less than 0.5 m
# in a minute.
. tests/scenes/lib.sh
MOST=60    # s
LOOKED=75 # s: longest run of a scene

# stood SCENE SECONDS [OPTION...]: prints the longest time, s, for which a person stood
stood() { "$JOSTLE" run "$1" --for "${@:2}" --quiet --summary - 2>/dev/null | tr '\n' ' ' | sed -n 's/.*"stood_longest": { *"s": \([0-9.]*\).*/\1/p'; }
# by_law BEHAVIOUR: true if its people keep a time gap
by_law() { grep -q 'time_gap = crowd.time_gap' "behaviours/$1.lua" 2>/dev/null; }

looked=0
for scene in scenes/*.yaml; do
    for behaviour in $(sed -n 's/.*behaviour: *\([a-z-]*\).*/\1/p' "$scene" | sort -u); do
        by_law "$behaviour" || continue
        seconds=$(sed -n 's/^duration: *\([0-9]*\).*/\1/p' "$scene")
        [ "$seconds" -le $LOOKED ] || seconds=$LOOKED
        name=$(basename "$scene" .yaml) most=$MOST
        fewer=()
        case $name in
        rimea-11 | counter-rooms | corridor-bo* | escalator) break ;; # jams for longer than is looked at (claims I8, N2.8, L2, S2)
        arena) fewer=(--set groups.people.count=2000) ;;
        san-fermin) fewer=(--set groups.crowd.count=700) ;;
        rimea-09 | imo-09) most=90 ;; # hundreds of people before each exit wait for their turn
        esac
        between "$name: nobody stands for $most s, of $seconds" "$(stood "$scene" "$seconds" "${fewer[@]}")" 0 $most
        looked=$((looked + 1))
        break
    done
done
between "number of scenes whose people walk by the walking law" $looked 20 1000

# A person who walks straight into a blind alley is reported.
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
between "seconds for which a person stands in a blind alley" "$(stood "$work/wall.yaml" 90)" 12 90 # turning round in it starts the count again
cat >"$work/held.yaml" <<'END'
jostle: 1
duration: 90
groups:
  one: {behaviour: stander.lua, at: [[0, 0]]}
END
between "seconds for which people stand who want to stand" "$(stood "$work/held.yaml" 90)" 0 0
