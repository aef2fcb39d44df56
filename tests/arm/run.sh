# The engine for AArch64, built with Debian's cross compiler and run under qemu: unit tests of the lower floors,
# kernels of NEON and scalar ones, and states of scenes that hash as this machine's do. `.ci/setup arm` installs
# what it needs.
. tests/scenes/lib.sh
export MAKEFLAGS=
arm=build/arm tests=
for file in tests/unit/{agents,base,simd,task,nav,force,machine}_*.c; do
    tests="$tests $(basename "$file" .c)"
done
make -s -j2 CROSS=aarch64-linux-gnu- CAIRO=0 VIEW=0 B=$arm CFLAGS=-Werror $arm/jostle $(printf " $arm/unit/%s" $tests) >"$work/build" 2>&1
verdict "gcc builds for AArch64 without a warning" $?
grep -aE -A 3 'error|warning' "$work/build" | head -20
for test in $tests; do
    timeout 300 qemu-aarch64 $arm/unit/$test >"$work/test" 2>&1
    verdict "unit test $test" $?
    grep -a 'FAILED' "$work/test" | head -5
done

printf '#!/bin/sh\nexec qemu-aarch64 %s/jostle "$@"\n' $arm >"$work/jostle"
chmod +x "$work/jostle"
there() { # ISA SCENE ARGS...
    local isa=$1; shift
    hash_of "$work/jostle" "$@" --isa $isa
}
both() { # SCENE ARGS...: here, and there by each instruction set, with threads and without
    local scene=scenes/$1.yaml; shift
    same_hash "$scene $*" "$(hash_of "$JOSTLE" "$scene" "$@")" "$(there neon "$scene" "$@")" "$(there scalar "$scene" "$@" --threads 2)"
}
both tawaf --set groups.pilgrims.count=2000 --set sources.0.keep=2000 --for 3
both arena --for 0.5
both station --for 12
# Every scene without bodies, for a short time.
for file in $(grep -LE '^ *bodies:|shape:' scenes/*.yaml); do
    less=$(.ci/smaller "$file")
    same_hash "$file, short" "$(hash_of "$JOSTLE" "$file" --for 0.5 $less)" "$(there neon "$file" --for 0.5 $less)"
done
# Bullet is Debian's own build for each kind of machine: with bodies the kernels agree, not the machines.
same_hash "scenes/office.yaml, NEON and scalar" "$(there neon scenes/office.yaml --for 3)" "$(there scalar scenes/office.yaml --for 3)"
# What one of them saved, the other goes on with.
"$work/jostle" run scenes/evacuation.yaml --for 6 --checkpoint 3 --checkpoint-dir "$work/ck" --quiet
same_hash "a checkpoint of AArch64 resumed here" "$(hash_of "$JOSTLE" scenes/evacuation.yaml --for 6)" \
    "$("$JOSTLE" resume "$work/ck/before.checkpoint" --quiet --summary - | figure hash)"
exit 0
