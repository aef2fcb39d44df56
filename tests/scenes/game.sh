# Games of scenes: who wins a round and when it is over, levels, ties, resumed rounds, what is refused.
. tests/scenes/lib.sh
cat >"$work/counter.lua" <<'END'
local mine = memory { points = 0 }
return machine { name = "counter", version = 1, start = "A", own = { pause = 1 }, states = {
  A = { steer = hold, lasts = own.pause, { to = "B", when = lasted, set = { points = mine.points + 1 } } },
  B = { steer = hold, { to = "A" } } } }
END
# game NAME RULES: writes a scene in which `us` score each 1 s or so and `them` each 2 s.
game() {
    cat >"$work/$1.yaml" <<END
jostle: 1
duration: 20
groups:
  us: {behaviour: counter.lua, at: [[0, 0]]}
  them: {behaviour: counter.lua, at: [[5, 0]], set: {pause: 2}}
player: us
tally:
  us: {memory: points, group: us}
  them: {memory: points, group: them}
game: {ours: us, theirs: them, $2}
END
}
# of FIGURE: a figure of the last run's game.
of() { sed -n '/"game": {/,/}/p' "$work/s.json" | sed -n "s/.*\"$1\": \"*\([^\",]*\)\"*,*\$/\1/p"; }
play() { "$JOSTLE" run "$work/$1.yaml" --summary "$work/s.json" "${@:2}" >"$work/out" 2>&1; }
won() { [ "$(of over) $(of winner) $(of ours) $(of theirs)" = "$2" ]; verdict "$1" $? || sed -n '/"game"/,/}/p' "$work/s.json"; }

game points "points: 5"
play points
won "the first to five points has won" "true us 5 2"
between "the run ends with the round" "$(figure simulated_s <"$work/s.json" | cut -d. -f1)" 4 6
tr '\n' ' ' <"$work/out" | grep -q "won by us, 5 to 2\."; verdict "the last lines tell the winner" $?
hash=$(figure hash <"$work/s.json")
play points --for 12
won "a run of a given length goes on, and the round stays as it ended" "true us 5 2"
between "  it is as long as was asked" "$(figure simulated_s <"$work/s.json" | cut -d. -f1)" 12 12
game time "points: 50, time: 7"
play time
won "at the end of the time the greater score wins" "true us 6 3"
game all "all: us"
play all
won "a round ends when the scores count all of a group" "true us 1 0"
for tie in draw ours theirs; do
    game "tie-$tie" "points: 3, tie: $tie"
    sed -i 's/set: {pause: 2}//' "$work/tie-$tie.yaml"
    play "tie-$tie"
    case $tie in draw) winner=null ;; ours) winner=us ;; theirs) winner=them ;; esac
    won "a tie: $tie" "true $winner 3 3"
done
play points --for 2
won "a round that is not over has no winner" "false null 1 0"
tr '\n' ' ' <"$work/out" | grep -q "The round is not over: us 1, them 0\."; verdict "  the last lines say so" $?
game levels "points: 5, levels: {even: {}, fast: {group: them, set: {pause: 0.5}}}"
play levels
won "without a choice the first level is played" "true us 5 2"
play levels --set game.level=fast
won "a level sets values of a group" "true them 2 5"
[ "$(of level)" = fast ]; verdict "  the summary names it" $?
"$JOSTLE" run "$work/levels.yaml" --seeds 3 --set game.level=fast --summary "$work/many.json" --quiet 2>/dev/null
grep -q '"game.lost": {"mean": 1' "$work/many.json"; verdict "who won is a figure of several runs" $?
"$JOSTLE" run "$work/points.yaml" --checkpoint 2 --checkpoint-dir "$work/ck" --quiet 2>/dev/null
"$JOSTLE" resume "$work/ck/before.checkpoint" --quiet --summary "$work/s.json" 2>/dev/null
won "a resumed round ends as it would have" "true us 5 2"
same_hash "  with the same hash" "$hash" "$(figure hash <"$work/s.json")"

refused() { # NAME RULES POSITION MESSAGE
    game bad "$2"
    play bad && echo "not ok $1: it runs" && return
    grep -q "bad.yaml:$3: $4" "$work/out"; verdict "$1" $? || cat "$work/out"
}
refused "a group of a level that there is not" "points: 5, levels: {a: {group: thm, set: {pause: 1}}}" 10:63 "there is no group 'thm'. Did you mean 'them'?"
refused "a game that does not end" "rounds: 3" 10:7 "a game needs an end of its rounds: points, time or all. points: 5"
refused "a level that there is not" "points: 5, level: esy, levels: {easy: {}, hard: {}}" 10:50 "there is no level 'esy'. Did you mean 'easy'?"
refused "values of a level without a group" "points: 5, levels: {hard: {set: {pause: 1}}}" 10:64 "a level sets values for the agents of a \`group\`. Add group: NAME"
game bad "points: 5"
sed -i 's/theirs: them/theirs: tehm/; /^player/d' "$work/bad.yaml"
play bad
grep -q "bad.yaml:9:26: there is no tally 'tehm'. Did you mean 'them'?" "$work/out"; verdict "a tally that there is not" $?
sed -i 's/tehm/them/' "$work/bad.yaml"
play bad
grep -q "a game needs a \`player\`. player: red" "$work/out"; verdict "a game without a player" $?

# The shipped games: the machine in the player's place wins more rounds against easier opponents, and a player who
# stands still loses.
share() { # SCENE LEVEL SEEDS [ARGUMENT...]: rounds won, in percent
    "$JOSTLE" run "scenes/$1.yaml" --no-mods --seeds "$3" --set "game.level=$2" --quiet --summary - "${@:4}" 2>/dev/null |
        sed -n 's/.*"game.won": {"mean": \([0-9.]*\).*/\1/p' | awk '{print int(100 * $1 + 0.5)}'
}
for scene in dodgeball:12 tackle:12 catch:60; do # levels of catch lie closer together
    seeds=${scene#*:} scene=${scene%:*}
    easy=$(share $scene easy $seeds) normal=$(share $scene normal $seeds) hard=$(share $scene hard $seeds)
    [ "$easy" -ge 60 ] && [ "$easy" -gt "$normal" ] && [ "$normal" -gt "$hard" ] && [ "$hard" -le 40 ]
    verdict "$scene: easy is easier than normal, normal than hard: $easy, $normal and $hard % of rounds are won" $?
    player=0
    [ $scene = tackle ] && player=13
    echo "0 player $player 0 0" >"$work/idle.input"
    between "$scene: who stands still loses" "$(share $scene easy 4 --input "$work/idle.input")" 0 0
done
exit 0
