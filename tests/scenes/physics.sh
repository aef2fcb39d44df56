# Shipped scenes: physical figures of their summaries and recordings.
. tests/scenes/lib.sh
sql() { sqlite3 "$1" "$2"; }

"$JOSTLE" run scenes/tawaf.yaml --quiet --set groups.pilgrims.count=6000 --set sources.0.keep=6000 \
    --set "places.mataf.polygon=$(: )" --for 1 >/dev/null 2>&1
[ $? = 3 ]; verdict "a polygon of text is bad input" $?

"$JOSTLE" run scenes/tawaf.yaml --quiet --for 20 --set groups.pilgrims.count=6000 --set sources.0.keep=6000 \
    --record "$work/t.sqlite" --summary "$work/t.json" 2>/dev/null
verdict "the Tawaf records" $?
between "the Tawaf keeps its number of people" "$(figure agents <"$work/t.json")" 6000 6000
between "nobody in the Kaaba" "$(sql "$work/t.sqlite" "SELECT count(*) FROM trajectory_data WHERE pos_x BETWEEN -5.4 AND 5.2 AND pos_y BETWEEN -6.2 AND 6.1")" 0 0
between "nobody in the Maqam" "$(sql "$work/t.sqlite" "SELECT count(*) FROM trajectory_data WHERE pos_x BETWEEN 15.85 AND 16.75 AND pos_y BETWEEN -1.45 AND -0.55")" 0 0
# Angular momentum about the Kaaba is counter-clockwise for nearly all moving people.
between "share of moving people who circle counter-clockwise" "$(sql "$work/t.sqlite" "
    SELECT avg((a.pos_x * (b.pos_y - a.pos_y) - a.pos_y * (b.pos_x - a.pos_x)) > 0)
    FROM trajectory_data a JOIN trajectory_data b ON a.id = b.id AND b.frame = 200 WHERE a.frame = 100")" 0.95 1
between "nobody is faster than the cap" "$(sql "$work/t.sqlite" "
    SELECT max((a.pos_x - b.pos_x) * (a.pos_x - b.pos_x) + (a.pos_y - b.pos_y) * (a.pos_y - b.pos_y)) * 100
    FROM trajectory_data a JOIN trajectory_data b ON a.id = b.id AND b.frame = a.frame + 1
    WHERE a.frame BETWEEN 50 AND 60")" 0.1 9
between "overlap, 99th percentile, of a diameter" "$(figure overlap_p99 <"$work/t.json")" 0 0.05
between "number of recorded frames" "$(sql "$work/t.sqlite" "SELECT count(DISTINCT frame) FROM trajectory_data")" 200 200
[ "$(sql "$work/t.sqlite" "SELECT value FROM metadata WHERE key = 'version'")" = 2 ]; verdict "the recording has format version 2" $?

"$JOSTLE" run scenes/evacuation.yaml --quiet --for 20 --record "$work/e.sqlite" --record-every 1 2>/dev/null
[ "$(sql "$work/e.sqlite" "SELECT count(DISTINCT frame) || ' ' || max(frame) || ' ' || (SELECT value FROM metadata WHERE key = 'fps') FROM trajectory_data")" = "20 20 1" ]
verdict "--record-every 1 records a frame per second" $?

"$JOSTLE" run scenes/circle.yaml --for 400 --quiet --summary "$work/c.json"
between "circle: agents that arrive" "$(grep -o '"Rest": [0-9]*' "$work/c.json" | grep -o '[0-9]*')" 900 1000

for forces in true false; do
    "$JOSTLE" run scenes/running-through.yaml --quiet --set forces.enabled=$forces --record "$work/r-$forces.sqlite"
    moved[$([ $forces = true ] && echo 1 || echo 0)]=$(sql "$work/r-$forces.sqlite" "
        SELECT avg(most) FROM (SELECT max(abs(a.pos_x - b.pos_x) + abs(a.pos_y - b.pos_y)) AS most
        FROM trajectory_data a JOIN trajectory_data b ON a.id = b.id WHERE a.frame = 1 AND a.id < 25 GROUP BY a.id)")
done
between "running-through: greatest displacement of pushed people, m" "${moved[1]}" 0.05 2
awk -v a="${moved[1]}" -v b="${moved[0]}" 'BEGIN {exit !(a > b)}'; verdict "displacement is greater than without forces (${moved[1]} against ${moved[0]})" $?

"$JOSTLE" run scenes/dodgeball.yaml --for 30 --quiet --summary "$work/d.json" --record "$work/d.sqlite"
between "balls are kicked" "$(sed -n '/"events"/,/}/s/.*"kicks": \([0-9]*\).*/\1/p' "$work/d.json")" 1 100
# In the substep in which it lands, a ball sinks in by less than its radius.
between "the ball's centre stays above ground" "$(sql "$work/d.sqlite" "SELECT min(z) FROM jostle_body")" 0 0.2
between "the player moves as the input log says" "$(sql "$work/d.sqlite" "SELECT max(pos_x) - min(pos_x) FROM trajectory_data WHERE id = 0")" 1 16

# Walls of glued blocks: people stop before them, rows press, and then weak glue breaks.
bonds() { grep -o "\"$1\": [-0-9.e]*" "$2" | grep -o '[-0-9.e]*$'; }
mean() { grep -o "\"bonds.$1\": {\"mean\": [-0-9.e]*" "$2" | grep -o '[-0-9.e]*$'; }
"$JOSTLE" run scenes/wall-breaking.yaml --for 20 --seeds 12 --quiet --summary "$work/w.json"
between "a weak wall breaks" "$(mean broken "$work/w.json")" 1 450
between "speed of the front before the wall breaks, m/s" "$(mean front_speed "$work/w.json")" 0 0.1
between "rows that press on the wall" "$(mean rows_pressing "$work/w.json")" 3 100
"$JOSTLE" run scenes/wall-tight.yaml --for 30 --quiet --summary "$work/w.json"
between "a tight wall holds" "$(bonds broken "$work/w.json")" 0 0
turned=$(bonds turned "$work/w.json")
between "angle by which the tight wall turns, degrees" "${turned#-}" 3 180
"$JOSTLE" run scenes/wall-heavy.yaml --for 30 --quiet --summary "$work/w.json"
between "displacement of a heavy wall, m" "$(bonds moved "$work/w.json")" 0 0.1
# A row of people who are pressed from both ends: feet hold it, and without them it buckles.
aside() {
    local stance=$1 person sets=(); shift
    for person in 1 2 3 4 5; do sets+=(--set "groups.p$person.set.stance=$stance"); done
    "$JOSTLE" run scenes/pressed-row.yaml --quiet "${sets[@]}" --summary "$work/row.json" "$@"
    grep -o '"peak": [-0-9.e]*' "$work/row.json" | grep -o '[-0-9.e]*$'
}
between "how far feet let people of a pressed row aside, m" "$(aside 0.0825)" 0 0.01
between "  with a step of 0.0125 s, m" "$(aside 0.0825 --dt 0.0125)" 0 0.01
between "  without feet that hold, m" "$(aside 0)" 0.1 2

# A plank that is thrown up with a spin about its length falls on its side, and has not turned about the vertical.
cat >"$work/plank.yaml" <<'SCENE'
jostle: 1
duration: 3
bodies: [{name: plank, shape: {blocks: {size: [0.4, 0.4, 0.3], count: [1, 4, 1], bond: 1000 kN}}, mass: 40, at: [0, 0, 0.15], turn: 30}]
groups: {people: {behaviour: stander.lua, at: [[9, 9]]}}
events: [{at: 0.5, throw: plank, velocity: [0, 0, 4], spin: [-1, 1.732, 0]}]
SCENE
"$JOSTLE" run "$work/plank.yaml" --quiet --summary "$work/w.json"
between "angle by which a plank turns that tips over, degrees" "$(bonds turned "$work/w.json")" -5 5
"$JOSTLE" run scenes/office.yaml --for 20 --quiet --summary "$work/o.json"
between "office: error of the momentum balance" "$(bonds residual "$work/o.json")" 0 0.00001
