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
sed -i "s|^prefix=.*|prefix=$top|" "$top"/lib/pkgconfig/*.pc
export PKG_CONFIG_PATH=$top/lib/pkgconfig
gcc -std=c17 -Wall -Wextra -Werror tests/install/embed.c $(pkg-config --cflags --libs jostle) -lm -o "$dir/shared" &&
    LD_LIBRARY_PATH=$top/lib "$dir/shared"
verdict "the example with the shared library" $?
gcc -std=c17 tests/install/embed.c $(pkg-config --cflags jostle) "$top/lib/libjostle.a" \
    $(pkg-config --static --libs jostle | sed 's/-ljostle//') -lm -o "$dir/static" && "$dir/static"
verdict "the example with the static library" $?
for example in loop ascii bodies host; do
    gcc -std=c17 -Wall -Wextra -Werror tests/install/$example.c $(pkg-config --cflags --libs jostle) -lm -pthread -o "$dir/$example" &&
        (cd "$top/share/jostle" && LD_LIBRARY_PATH=$top/lib "$dir/$example") >"$dir/said" 2>&1
    verdict "the example $example" $? ; tail -3 "$dir/said"
done
g++ -std=c++17 -Wall -Wextra -Wpedantic -Werror tests/install/loop.cpp $(pkg-config --cflags --libs jostle) -o "$dir/loop-cpp" &&
    (cd "$top/share/jostle" && LD_LIBRARY_PATH=$top/lib "$dir/loop-cpp") >"$dir/said" 2>&1
verdict "the example in C++" $? ; tail -2 "$dir/said"
g++ -std=c++17 -Wall -Wextra -Werror tests/install/bullet.cpp $(pkg-config --cflags jostle) $(pkg-config --cflags bullet | sed 's/-I/-isystem /g') \
    $(pkg-config --libs jostle bullet) -o "$dir/bullet" && LD_LIBRARY_PATH=$top/lib "$dir/bullet" >"$dir/said" 2>&1
verdict "bodies of a Bullet world of the program's own are pushed as Jostle's are, and push" $? ; cat "$dir/said"
# CMake finds it where it lies, which is not where it was installed for.
cmake -S tests/install/cmake -B "$dir/cmake" -DCMAKE_PREFIX_PATH="$top" -DCMAKE_BUILD_TYPE=Release >"$dir/said" 2>&1 && cmake --build "$dir/cmake" >>"$dir/said" 2>&1
verdict "CMake builds the examples with the shared and the static libraries" $? ; grep -iE -A 3 'error' "$dir/said" | head -20
for kind in shared static; do
    "$dir/cmake/$kind" >"$dir/said" 2>&1 && (cd "$top/share/jostle" && "$dir/cmake/$kind-cpp") >>"$dir/said" 2>&1 &&
        "$dir/cmake/$kind-tools" "$top/share/jostle/scenes/circle.yaml" "$dir/cmake/$kind.png" >>"$dir/said" 2>&1 && [ -s "$dir/cmake/$kind.png" ]
    verdict "  they run with the $kind libraries" $? ; tail -3 "$dir/said"
done
ask_cmake() { # ARGUMENTS-OF-FIND_PACKAGE: prints what CMake says
    mkdir -p "$dir/ask"
    printf 'cmake_minimum_required(VERSION 3.13)\nproject(ask C)\nfind_package(jostle %s)\n' "$1" >"$dir/ask/CMakeLists.txt"
    cmake -S "$dir/ask" -B "$dir/ask/build" -DCMAKE_PREFIX_PATH="$top" 2>&1
}
ask_cmake "0.1 CONFIG REQUIRED" >"$dir/said" ; verdict "CMake takes its version" $? ; tail -3 "$dir/said"
! ask_cmake "0.2 CONFIG REQUIRED" >"$dir/said" && grep -q 'version: 0.1.0' "$dir/said"; verdict "  and refuses a later one" $? ; tail -3 "$dir/said"
! ask_cmake "CONFIG REQUIRED COMPONENTS pictures" >"$dir/said" && grep -q 'there is no component pictures' "$dir/said"
verdict "  and names the components, asked for another" $? ; [ "$(grep -c CMake "$dir/said")" -gt 0 ] || tail -3 "$dir/said"
# The engine alone needs no cairo, no web server; the headers alone name no other's folder.
! LC_ALL=C ldd "$top/lib/libjostle.so.0" | grep -qE 'cairo|websockets|ssl|X11|fontconfig'
verdict "the library needs what the engine needs" $? ; LC_ALL=C ldd "$top/lib/libjostle.so.0" | awk '{print "    " $1}'
[ "$(pkg-config --cflags jostle jostle-tools | xargs)" = "-I$top/include" ]; verdict "pkg-config names one folder" $? ; pkg-config --cflags jostle jostle-tools
gcc -std=c17 -Wall -Wextra -Werror tests/install/picture.c $(pkg-config --cflags --libs jostle-tools) -o "$dir/picture" &&
    (cd "$dir" && LD_LIBRARY_PATH=$top/lib "$dir/picture" "$top/share/jostle/scenes/circle.yaml" circle.png && [ -s circle.png ])
verdict "a picture by the library with tools" $?
(cd "$dir" && "$top/bin/jostle" run "$top/share/jostle/scenes/running-through.yaml" --steps 10 --quiet)
verdict "an installed scene runs" $?
[ -s "$top/share/man/man1/jostle.1" ]; verdict "the man page" $?
[ -s "$top/share/jostle/page/index.html" ] && [ -s "$top/share/jostle/page/main.js" ] &&
    [ -s "$top/share/jostle/page/three.LICENSE.txt" ] &&
    ! grep -qE '(^|[;}])import *[{*"a-zA-Z]|(src|href)="?(https?:)?//' "$top/share/jostle/page/"{index.html,style.css,main.js}
verdict "the live page, in one bundle that loads nothing from elsewhere" $?
make -s uninstall PREFIX=/opt/jostle-test DESTDIR="$dir" >/dev/null
[ -z "$(find "$top" -type f -o -type l)" ]; verdict "uninstall leaves nothing" $?
