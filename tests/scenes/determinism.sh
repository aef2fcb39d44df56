# Equal hashes for 1, 2 and 4 threads, every instruction set that the machine runs, two processes, -O0 and -O2,
# gcc and clang.
. tests/scenes/lib.sh
export MAKEFLAGS=
make -s -j2 MODE=debug B=build/debug CFLAGS=-Werror build/debug/jostle
verdict "gcc -O0 builds without a warning" $?
make -s -j2 CC=clang CXX=clang++ B=build/clang CFLAGS=-Werror build/clang/jostle
verdict "clang builds without a warning" $?
isas=
for isa in scalar sse2 avx2 avx512 neon; do
    if "$JOSTLE" run scenes/circle.yaml --steps 1 --quiet --isa $isa 2>/dev/null; then isas="$isas $isa"; fi
done
by_isa() { # SCENE ARGS...: the hash by each instruction set, with two threads
    local isa
    for isa in $isas; do hash_of "$JOSTLE" "$@" --isa $isa --threads 2; done
}
[ "${isas# scalar}" != "$isas" ]
verdict "instruction sets compared:$isas" $?
compare() { # SCENE ARGS...
    local scene=scenes/$1.yaml one; shift
    one=$(hash_of "$JOSTLE" "$scene" "$@")
    same_hash "$scene threads" "$one" "$(hash_of "$JOSTLE" "$scene" "$@" --threads 2)" "$(hash_of "$JOSTLE" "$scene" "$@" --threads 4)"
    same_hash "$scene instruction sets" "$one" $(by_isa "$scene" "$@")
    same_hash "$scene processes" "$one" "$(hash_of "$JOSTLE" "$scene" "$@")"
    same_hash "$scene -O0" "$one" "$(hash_of build/debug/jostle "$scene" "$@")"
    same_hash "$scene clang" "$one" "$(hash_of build/clang/jostle "$scene" "$@")"
    if [ "$scene" = scenes/tawaf.yaml ]; then
        [ "$one" != "$(hash_of "$JOSTLE" "$scene" "$@" --seed 99)" ]
        verdict "$scene another seed differs" $?
    fi
}
compare tawaf --set groups.pilgrims.count=5000 --set sources.0.keep=5000 --steps 60
compare dodgeball --for 20
compare running-through --for 10
compare evacuation --for 15
compare catch --for 20
compare station --for 12
compare gates --for 25
compare wall-breaking --for 14
compare office --for 8
compare dodgeball-500 --for 4
compare office --set groups.people.count=300 --for 5 --input tests/data/session.input
# And every scene, for a short time.
for file in scenes/*.yaml; do
    less=$(.ci/smaller "$file")
    same_hash "$file, short" "$(hash_of "$JOSTLE" "$file" --for 4 --set "$less")" \
        "$(hash_of "$JOSTLE" "$file" --for 4 --set "$less" --threads 2)" "$(hash_of build/debug/jostle "$file" --for 4 --set "$less" --isa scalar)"
done
exit 0
