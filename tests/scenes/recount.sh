# Figures of a report, counted again from the recording of the same run by a script that shares no code with it.
. tests/scenes/lib.sh
python=$(command -v /usr/bin/python3 || command -v python3) # Debian's has numpy
"$JOSTLE" run scenes/evacuation.yaml --for 60 --quiet --no-half-step --record "$work/run.sqlite" --record-every 0.05 --report "$work/page" >/dev/null 2>&1
verdict "a run with a report and a recording" $?
"$python" tests/scenes/recount.py "$work/run.sqlite" "$work/page"
# The null: with a person taken out of the recording, the counts must differ.
"$python" tests/scenes/recount.py "$work/run.sqlite" "$work/page" --drop 7 >"$work/out"
[ $? = 1 ] && grep -q "^not ok people who left (recounted 139, reported 140" "$work/out" && grep -q "^not ok crossings of" "$work/out"; verdict "a recording that lacks a person does not pass" $?
