#!/bin/bash
# tests/wasm/run.sh: tests of the engine in WebAssembly under Node.js: its interface, and that the hashes of all scenes after 400
# steps, and of three after 5,000, are those of this machine's build. `make wasm-test` builds both and runs it.
# JOSTLE_WASM_SCENES names the scenes that are run for 400 steps (default: all).
set -u
cd "$(dirname "$0")/../.."
. tests/scenes/lib.sh
jobs=${JOBS:-$(nproc)}
[ -e build/wasm/out/jostle.wasm ] || { echo "not ok build/wasm/out is missing: make wasm"; exit 1; }

# compare STEPS SCENE...: runs each scene in both builds. Crowds of many thousand people are made smaller, as for slow builds.
compare() {
    local steps=$1 scene; shift
    export JOSTLE steps
    for scene in "$@"; do echo "$scene $(.ci/smaller "$scene")" | sed 's/ *$//'; done >"$work/scenes"
    xargs -P "$jobs" -L 1 sh -c 'scene=$1; echo "$scene $("$JOSTLE" run "$@" --steps "$steps" --no-mods --threads 1 --quiet --summary - 2>/dev/null |
        sed -n "s/^ \"hash\": \"\([0-9a-f]*\)\".*/\1/p")"' sh <"$work/scenes" | sort >"$work/native"
    split -n "r/$jobs" "$work/scenes" "$work/part."
    ls "$work"/part.* | xargs -P "$jobs" -I{} sh -c "node tests/wasm/hashes.mjs $steps <{}" | sort >"$work/wasm"
    rm -f "$work"/part.*
    for scene in "$@"; do
        same_hash "$scene, $steps steps" "$(sed -n "s,^$scene ,,p" "$work/native")" "$(sed -n "s,^$scene ,,p" "$work/wasm")"
    done
}

node build/wasm/test/lanes.cjs || verdict "the lanes ended with an error" 1
node tests/wasm/engine.mjs || verdict "the interface ended with an error" 1
node tests/wasm/attacks.mjs || verdict "the hostile behaviours ended with an error" 1
compare 400 ${JOSTLE_WASM_SCENES:-scenes/*.yaml}
compare 5000 scenes/circle.yaml scenes/office.yaml scenes/dodgeball.yaml
