# The module for stock Lua (scripts/lua): the same hashes as the program's, reading, errors, messages, closing.
. tests/scenes/lib.sh
case $B in build/release*) ;; *) echo "ok the module of Lua (left out: it is that of a release build)"; exit ;; esac
JOSTLE_HASH=$(hash_of "$JOSTLE" scenes/catch.yaml --seed 3 --for 5) LUA_CPATH="$B/lua/?.so;;" lua5.4 tests/data/module.lua "$work" >"$work/out" 2>&1
status=$?
cat "$work/out"
[ $status = 0 ] && grep -q '^ok closed' "$work/out"; verdict "the test program in Lua runs to its end" $?
[ "$(nm -D --defined-only "$B/lua/jostle.so" | wc -l)" = 1 ]; verdict "the module exports only luaopen_jostle" $?
