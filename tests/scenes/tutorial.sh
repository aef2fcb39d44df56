# Follows the tutorial of behaviours/README.md: writes every block that names a file and runs every command, in order.
# With PICTURES=DIR the pictures are kept there.
. tests/scenes/lib.sh
program=$(case $JOSTLE in /*) echo "$JOSTLE" ;; *) echo "$PWD/$JOSTLE" ;; esac)
awk -v dir="$work" '
    /^```(lua|yaml) / {file = dir "/" $2; printf "" > file; printf "write %s\n", $2; next}
    /^```sh$/ {commands = 1; next}
    /^```$/ {if (file) close(file); file = ""; commands = 0; next}
    file {print > file; text[file] = text[file] $0 "\n"}
    commands {print "run " $0}
' behaviours/README.md >"$work/steps"
[ "$(grep -c '^run ' "$work/steps")" -ge 4 ]; verdict "the tutorial has at least four runs" $?
# awk has written the last version of each file; now do it step by step.
n=0
while read -r what rest; do
    if [ "$what" = write ]; then
        n=$((n + 1))
        awk -v want="$n" '/^```(lua|yaml) / {k++; on = k == want; next} /^```$/ {on = 0} on' behaviours/README.md >"$work/$rest"
    else
        (cd "$work" && eval "$(echo "$rest" | sed "s|^jostle|$program|") --quiet" >log 2>&1 ||
            eval "$(echo "$rest" | sed "s|^jostle|$program|")" >log 2>&1)
        status=$?
        [ $status = 0 ] && ! grep -q 'error\|warning' "$work/log"; verdict "$rest" $?
    fi
done <"$work/steps"
for step in step3 step4 step6; do
    [ -s "$work/$step/paths.png" ]; verdict "$step has a picture" $?
    [ -z "$PICTURES" ] || cp "$work/$step/paths.png" "$PICTURES/$step.png"
done
# The behaviour and the scene of the project's README.
mkdir "$work/readme"
awk '/^```lua$/ {on = 1; next} /^```$/ {on = 0} on' README.md >"$work/readme/shy.lua"
awk '/^```yaml$/ {on = 1; next} /^```$/ {on = 0} on' README.md >"$work/readme/yard.yaml"
(cd "$work/readme" && "$program" check . && "$program" run yard.yaml --for 10 --quiet --summary -) >"$work/log" 2>&1
[ $? = 0 ] && grep -q '^nothing wrong' "$work/log"; verdict "the README's behaviour and scene run" $?
exit 0
