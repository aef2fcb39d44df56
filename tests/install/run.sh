# Installs into a folder of its own, builds the example against it, removes it all again.
set -u
cd "$(dirname "$0")/../.."
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
verdict() { if [ "$2" = 0 ]; then echo "ok $1"; else echo "not ok $1"; fi; }
export MAKEFLAGS=
make -s install PREFIX=/opt/jostle-test DESTDIR="$dir" >"$dir/log" 2>&1
verdict "install" $? ; tail -3 "$dir/log"
top=$dir/opt/jostle-test
sed -i "s|^prefix=.*|prefix=$top|" "$top/lib/pkgconfig/jostle.pc"
export PKG_CONFIG_PATH=$top/lib/pkgconfig
gcc -std=c17 -Wall -Wextra -Werror tests/install/embed.c $(pkg-config --cflags --libs jostle) -lm -o "$dir/shared" &&
    LD_LIBRARY_PATH=$top/lib "$dir/shared"
verdict "the example with the shared library" $?
gcc -std=c17 tests/install/embed.c $(pkg-config --cflags jostle) "$top/lib/libjostle.a" \
    $(pkg-config --static --libs jostle | sed 's/-ljostle//') -lm -o "$dir/static" && "$dir/static"
verdict "the example with the static library" $?
for example in loop ascii bodies; do
    gcc -std=c17 -Wall -Wextra -Werror tests/install/$example.c $(pkg-config --cflags --libs jostle) -lm -o "$dir/$example" &&
        (cd "$top/share/jostle" && LD_LIBRARY_PATH=$top/lib "$dir/$example") >"$dir/said" 2>&1
    verdict "the example $example" $? ; tail -3 "$dir/said"
done
(cd "$dir" && "$top/bin/jostle" run "$top/share/jostle/scenes/running-through.yaml" --steps 10 --quiet)
verdict "an installed scene runs" $?
[ -s "$top/share/man/man1/jostle.1" ]; verdict "the man page" $?
[ -s "$top/share/jostle/page/index.html" ]; verdict "the live page" $?
make -s uninstall PREFIX=/opt/jostle-test DESTDIR="$dir" >/dev/null
[ -z "$(find "$top" -type f -o -type l)" ]; verdict "uninstall leaves nothing" $?
