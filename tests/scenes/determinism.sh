# Compares hashes of scenes for 1, 2 and 4 threads, every instruction set that the machine runs, two processes, gcc and
# clang, and with another C library's functions (other_libm.c), within Bullet too. If JOSTLE_MATRIX names scenes (`make matrix`; "all": those below), also for 1 to 8 threads, 20
# processes, -O0 and -O3, reloads without a change, checkpoints at any time, recorder, report, page and trace, and beside a busy
# process.
. tests/scenes/lib.sh
export MAKEFLAGS=
case ${CC-} in ccache*) cached="ccache " ;; *) cached= ;; esac # as .ci/run compiles
make -s -j2 CC="${cached}clang" CXX="${cached}clang++" B=build/clang CFLAGS=-Werror build/clang/jostle
verdict "clang builds without a warning" $?
isas=
for isa in scalar sse2 avx2 avx512 neon; do
    if "$JOSTLE" run scenes/circle.yaml --steps 1 --quiet --isa $isa 2>/dev/null; then isas="$isas $isa"; fi
done
matrix=${JOSTLE_MATRIX:-}
others=
if [ "$matrix" ]; then # NAME=PROGRAM of further builds
    for build in "gcc-O0 gcc g++ -O0 debug" "gcc-O3 gcc g++ -O3 release" "clang-O0 clang clang++ -O0 debug" "clang-O3 clang clang++ -O3 release"; do
        set -- $build
        make -s -j2 CC="$cached$2" CXX="$cached$3" MODE="$5" B="build/$1" CFLAGS="$4" "build/$1/jostle" || echo "not ok $1 builds"
        others="$others $1"
    done
fi
by_isa() { # SCENE ARGS...: prints the hash for each instruction set, with two threads
    local isa
    for isa in $isas; do hash_of "$JOSTLE" "$@" --isa $isa --threads 2; done
}
[ "${isas# scalar}" != "$isas" ]
verdict "instruction sets compared:$isas" $?
quietly() { # SUMMARY-FILE PROGRAM ARGS...: runs a program that writes its summary to the file
    local out=$1; shift
    rm -f "$out"
    "$@" --summary "$out" >"$work/said" 2>&1 </dev/null
}
# watched: runs in real time with a page that a client (look.py) looks at
watched() { # SCENE ARGS...: prints the hash
    local scene=$1 pid address; shift
    rm -f "$work/page.json"
    timeout --foreground 600 "$JOSTLE" run "$scene" --view "$@" --summary "$work/page.json" >"$work/said" 2>&1 </dev/null & pid=$!
    for _ in $(seq 100); do
        address=$(grep -o 'http://[^ ]*' "$work/said" 2>/dev/null) && break
        sleep 0.05
    done
    python3 tests/page/look.py "$address" >"$work/seen" 2>&1 &
    until grep -q ' are over' "$work/said" || ! kill -0 $pid 2>/dev/null; do sleep 0.1; done
    kill -TERM $pid; wait
    figure hash <"$work/page.json"
}
reloaded() { # SCENE ARGS...: prints the hash of a run in which behaviours are reloaded at some steps with a new comment
    local scene=$1 file tick; shift
    "$JOSTLE" run "$scene" --quiet --log-input "$work/made" "$@" 2>/dev/null
    for tick in $(seq 3 12 51); do
        for file in $(sed -n 's/^0 made \(.*\.lua\) .*/\1/p' "$work/made"); do
            { cat "$file"; echo "-- $tick"; } >"$work/file.lua"
            printf '%d files 1\n%s %d\n' "$tick" "$file" "$(wc -c <"$work/file.lua")"
            cat "$work/file.lua"; echo
        done
    done >"$work/edits"
    rm -f "$work/reload.json"
    "$JOSTLE" run "$scene" --quiet --input "$work/edits" "$@" --summary "$work/reload.json" >"$work/said" 2>&1
    grep -c ' is live' "$work/said" >"$work/reloads"
    figure hash <"$work/reload.json"
}
checkpointed() { # SCENE ARGS...: prints the hashes of two runs that are resumed from checkpoints
    local scene=$1 every n; shift
    for n in 1 2; do
        every=$((RANDOM % 2)).$((10 + RANDOM % 90))
        rm -rf "$work/ck"
        quietly "$work/whole.json" "$JOSTLE" run "$scene" --quiet "$@" --checkpoint $every --checkpoint-dir "$work/ck"
        quietly "$work/rest.json" "$JOSTLE" resume "$work/ck/latest.checkpoint" --quiet --threads $((1 + RANDOM % 8))
        figure hash <"$work/whole.json"
        figure hash <"$work/rest.json"
    done
}
unmoved() { # SCENE HASH ARGS...: compares the hash of runs with everything that only observes or accompanies a run
    local scene=$1 one=$2 n hashes= pid; shift 2
    for n in 1 2 3 4 5 6 7 8; do hashes="$hashes $(hash_of "$JOSTLE" "$scene" "$@" --threads $n)"; done
    same_hash "$scene 1 to 8 threads" "$one" $hashes
    hashes=
    for n in $(seq 20); do hashes="$hashes $(MALLOC_PERTURB_=$n hash_of "$JOSTLE" "$scene" "$@")"; done
    same_hash "$scene 20 processes, addresses random ($(cat /proc/sys/kernel/randomize_va_space))" "$one" $hashes
    for n in $others; do same_hash "$scene $n" "$one" "$(hash_of "build/$n/jostle" "$scene" "$@")"; done
    same_hash "$scene recorder" "$one" "$(hash_of "$JOSTLE" "$scene" "$@" --record "$work/r.sqlite")"
    same_hash "$scene report" "$one" "$(hash_of "$JOSTLE" "$scene" "$@" --no-half-step --report "$work/report")"
    same_hash "$scene trace and log" "$one" "$(hash_of "$JOSTLE" "$scene" "$@" --trace 1 --log-input "$work/log")"
    sh -c 'while :; do :; done' & pid=$!
    same_hash "$scene beside a busy process" "$one" "$(hash_of "$JOSTLE" "$scene" "$@" --threads 2)" "$(hash_of "$JOSTLE" "$scene" "$@" --threads 4)"
    kill $pid; wait $pid 2>/dev/null
    hashes=$(watched "$scene" "$@")
    same_hash "$scene page, in $(cat "$work/seen") frames" "$one" "$hashes"
    case "$* $(grep -o "^input:" "$scene")" in *input*) ;; *)
        hashes=$(reloaded "$scene" "$@")
        same_hash "$scene $(cat "$work/reloads") reloads of nothing new" "$one" "$hashes"
        [ "$(cat "$work/reloads")" -ge 4 ] || echo "not ok $scene was not reloaded" ;;
    esac
    if ! grep -q '^bodies:' "$scene"; then same_hash "$scene checkpoints" "$one" $(checkpointed "$scene" "$@"); fi
}
compare() { # SCENE ARGS...: compares the hashes of one scene
    local scene=scenes/$1.yaml one
    case " ${matrix:-all} " in *" all "* | *" $1 "*) ;; *) return ;; esac
    shift
    one=$(hash_of "$JOSTLE" "$scene" "$@")
    same_hash "$scene threads" "$one" "$(hash_of "$JOSTLE" "$scene" "$@" --threads 2)" "$(hash_of "$JOSTLE" "$scene" "$@" --threads 4)"
    same_hash "$scene instruction sets" "$one" $(by_isa "$scene" "$@")
    same_hash "$scene processes" "$one" "$(hash_of "$JOSTLE" "$scene" "$@")"
    same_hash "$scene clang" "$one" "$(hash_of build/clang/jostle "$scene" "$@")"
    if [ "$matrix" ]; then unmoved "$scene" "$one" "$@"; fi
    if [ "$scene" = scenes/tawaf.yaml ]; then
        [ "$one" != "$(hash_of "$JOSTLE" "$scene" "$@" --seed 99)" ]
        verdict "$scene another seed differs" $?
    fi
}
compare tawaf --set groups.pilgrims.count=5000 --set sources.0.keep=5000 --for 3
compare dodgeball --for 20
compare running-through --for 10
compare evacuation --for 15
compare catch --for 20
compare tackle --for 8
compare rescue --for 12
compare pickpocket --for 40
compare drill --for 60
compare station --for 12
compare gates --for 25
compare train-doors --for 18
compare wall-breaking --for 14
compare office --for 8
compare dodgeball-500 --for 4
compare office --set groups.people.count=300 --for 5 --input tests/data/session.input
[ -z "$matrix" ] || exit 0
# Every shipped scene, for a short time.
gcc -O1 -fno-builtin -shared -fPIC -o "$work/other_libm.so" tests/scenes/other_libm.c -ldl -lm
LD_PRELOAD=$work/other_libm.so "$JOSTLE" run scenes/bottleneck.yaml --for 4 --quiet --summary - 2>&1 >/dev/null | grep -q 'other libm: [1-9]'
verdict "the other C library is in use, by the densities of a probe" $?
for file in scenes/*.yaml; do
    less=$(.ci/smaller "$file")
    same_hash "$file, short; two threads and another C library; clang and scalar" "$(hash_of "$JOSTLE" "$file" --for 4 $less)" \
        "$(LD_PRELOAD=$work/other_libm.so hash_of "$JOSTLE" "$file" --for 4 $less --threads 2)" \
        "$(hash_of build/clang/jostle "$file" --for 4 $less --isa scalar)"
done
exit 0
