# Input logs: what people do to a running scene, and files that they save, are written to a log that plays back to the
# same hash for any number of threads.
. tests/scenes/lib.sh
log=$work/session.input

# ---- every verb ----
script=tests/data/session.input
office() { "$JOSTLE" run scenes/office.yaml --set groups.people.count=300 --for 5 --quiet --summary - "$@" 2>"$work/err" | figure hash; }
one=$(office --input $script --log-input "$log")
[ ! -s "$work/err" ]; verdict "every verb is done" $?
cat "$work/err"
same_hash "a log of every verb plays back to the same hash" "$one" "$(office --input "$log")" "$(office --input "$log" --threads 2)" "$(office --input "$log" --threads 4)"
[ "$(grep -Ev '^#|^0 (began|made)' "$log")" = "$(grep -v '^#' $script)" ]
verdict "the log of a replay has the same entries" $?
head -1 "$log" | grep -q '^# input log of jostle .*: scene scenes/office.yaml, seed [0-9]*, dt 0.05 s$'
verdict "a log begins with version, scene, seed and step" $?
[ "$one" != "$(office)" ]; verdict "the entries change the hash" $?

# ---- walls ----
printf '20 open exit\n40 close exit\n' >"$work/gates.input"
name=$(sed -n 's/.*name: \([a-z_]*\)[,}].*/\1/p' scenes/gates.yaml | head -1)
sed -i "s/exit/$name/" "$work/gates.input"
gates() { hash_of "$JOSTLE" scenes/gates.yaml --for 6 --input "$work/gates.input" "$@"; }
same_hash "gates opened by a log have one hash for 1 and 2 threads" "$(gates)" "$(gates --threads 2)"
[ "$(gates)" != "$(hash_of "$JOSTLE" scenes/gates.yaml --for 6)" ]; verdict "gates opened by a log change the hash" $?

# ---- mistakes ----
printf '7 push 0 1 1\n8 shove 0\n5 push 0 1 1\n' >"$work/bad.input"
"$JOSTLE" run scenes/office.yaml --steps 1 --quiet --input "$work/bad.input" 2>"$work/err"
[ $? = 3 ] && grep -qF "bad.input:2:3: there is no verb 'shove'" "$work/err" && grep -qF 'bad.input:3:1: ticks must not decrease' "$work/err"
verdict "a wrong log is bad input, with line and column" $?
"$JOSTLE" run scenes/office.yaml --steps 1 --quiet --log-input "$work/no/such/folder" 2>"$work/err"
[ $? = 1 ] && grep -qF 'cannot write the input log' "$work/err"; verdict "an unwritable log is an error" $?

# ---- logs that drive nobody ----
drive() { # NAME LOG TEXT: plays a log among a player and a person who stands, and looks for a text
    printf "$2" >"$work/drive.input"
    "$JOSTLE" run "$work/drive.yaml" --for 3 --input "$work/drive.input" >"$work/said" 2>&1 </dev/null
    grep -qF -- "$3" <<<"$(tr '\n' ' ' <"$work/said" | tr -s ' ')"; verdict "$1" $?
}
cat >"$work/drive.yaml" <<'SCENE'
jostle: 1
bodies: [{shape: {sphere: {radius: 0.11}}, mass: 0.4, at: [7, 7, 0.11], tags: [ball]}]
groups:
  a_player: {behaviour: player.lua, at: [[4, 4]]}
  b_stander: {behaviour: stander.lua, at: [[2, 2]]}
SCENE
drive "a log that drives a person who never came says so" '0 player 7 1 0\n' 'drives agent 7, who never came: ids went up to 1.'
drive "a log that drives a person without player says so" '0 player 1 1 0\n' 'drives agent 1, whose behaviour stander has no `player`'
drive "a log that goes on after the run says so" '0 player 0 1 0\n100 player 0 0 0\n' 'The run ended before 1 entry of the input log: the next, in line 2, was due at 5.00 s.'
drive "an empty log says so" '# nothing\n' 'The input log is empty'
drive "a log that drives a person who has left says so" '20 remove 0\n30 player 0 1 0\n' 'drive.input:2: t = 1.50 s: agent 0 has left'
drive "entries that could not be done are counted at the end" '1 open gate\n2 push 77 1 1\n3 lift east firemen\n' 'The run skipped 3 entries of the input log: the first, in line 1, as there is no wall named'
drive "a lift that a scene lacks is told" '3 lift east firemen\n' 'drive.input:1: t = 0.15 s: there are no lifts'
drive "a mode that lifts do not have is bad input" '3 lift east broken\n' "drive.input:1:13: a lift has no mode 'broken'"
drive "a log that drives a player says nothing" '0 player 0 1 0\n' ''
! grep -q 'input log' "$work/said"; verdict "  and none of this" $?

# ---- saved files: 500 pilgrims, a behaviour, what it requires, and the scene ----
tree=$work/tree
mkdir -p "$tree/scenes" "$tree/behaviours"
cp scenes/tawaf.yaml "$tree/scenes/"
cp behaviours/*.lua "$tree/behaviours/"
scene=$tree/scenes/tawaf.yaml sheet=$tree/behaviours/tawaf.lua
few="--set groups.pilgrims.count=500 --set sources.0.keep=500 --no-mods --quiet"
log=$work/saved.input
"$JOSTLE" run "$scene" $few --steps 900000000 --watch --log-input "$log" --summary "$work/summary" >"$work/said" 2>&1 </dev/null &
pid=$!
trap '[ -z "$pid" ] || kill -KILL $pid; rm -rf "$work"' EXIT
lives() { # NAME TEXT: waits until the run has printed a text
    for i in $(seq 400); do
        grep -qF -- "$2" "$work/said" && break
        sleep 0.02
    done
    grep -qF -- "$2" "$work/said"; verdict "$1" $?
}
for i in $(seq 200); do
    [ "$(ls /proc/$pid/task 2>/dev/null | wc -l)" -lt 2 ] || break
    sleep 0.05
done
sleep 0.2
sed -i 's/push = shove/push = 33/' "$sheet"; lives "a saved behaviour" "version 1 (reload 1) is live"
sed -i 's/push = 33/puhs = 33/' "$sheet"; lives "one that does not load" "unknown key 'puhs'"
echo 'return 2.5' >"$tree/behaviours/extra.lua"
sed -i 's/^return machine/local extra = require "extra"\nreturn machine/; s/puhs = 33/push = extra/' "$sheet"
lives "one that requires a new file" "version 1 (reload 2) is live"
echo 'return 90' >"$tree/behaviours/extra.lua"; lives "what it requires" "version 1 (reload 3) is live"
sed -i 's/^events:/events:\n  - {at: 1, every: 0.5, signal: hello}/' "$scene"
grep -q '^events:' "$scene" || printf 'events:\n  - {at: 1, every: 0.5, signal: hello}\n' >>"$scene"
lives "the scene" "events changed, live"
kill -INT $pid
wait $pid; [ $? = 130 ]; verdict "the live session ends with the status of an interruption" $?
pid=
steps=$(figure steps <"$work/summary") hash=$(figure hash <"$work/summary")
again() { hash_of "$JOSTLE" "$scene" $few --steps "$steps" --input "$log" "$@"; }
same_hash "a log with saved files plays back to the same hash" "$hash" "$(again)" "$(again --threads 2)" "$(again --threads 4)"
echo 'return machine {}' >"$sheet"
rm "$tree/behaviours/extra.lua"
same_hash "a replay does not read the files on the disk" "$hash" "$(again --log-input "$work/again.input")"
cmp "$log" "$work/again.input"; verdict "the log of this replay is the same, byte by byte" $?
grep -qa '^ *local extra = require "extra"' "$log"; verdict "the log contains the texts of saved files unchanged" $?
"$JOSTLE" run "$scene" $few --steps 1 --input "$log" --watch 2>&1 | grep -qF 'cannot be watched besides'
verdict "a log with saved files is refused with --watch" $?
exit 0
