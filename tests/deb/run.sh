# tests/deb/run.sh FOLDER: the Debian packages in it. Lintian has nothing to say; in a new root, where nothing else is
# installed, the packages install with what they depend on, and the program, the library and the Python package run.
set -u
packages=$(realpath "$1")
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
failed=0
verdict() { if [ "$2" = 0 ]; then echo "ok $1"; else echo "not ok $1"; failed=1; fi; }

lintian --fail-on error,warning "$packages"/*.changes >"$dir/lintian" 2>&1
verdict "lintian" $? ; head -20 "$dir/lintian"
for name in jostle jostle-data libjostle0 libjostle-tools0 libjostle-dev lua-jostle python3-jostle jostle-doc; do
    ls "$packages/$name"_*.deb >/dev/null 2>&1; verdict "the package $name" $?
done

if [ "$(id -u)" != 0 ]; then echo "ok a new root (left out: only root makes one)"; exit $failed; fi
root=$dir/root
. tests/deb/root.sh
# Into it: the packages, and programs to compile.
make_root "$root" gcc,g++,libc6-dev,pkg-config,cmake,make,lua5.4 \
    "mkdir -p \"\$1/packages\" && cp -R '$packages'/*.deb tests/install/embed.c tests/install/cmake \"\$1/packages\"" \
    'chroot "$1" sh -c "apt-get install -y -q --no-install-recommends /packages/*.deb"' >"$dir/log" 2>&1
verdict "the packages install in a new root" $?; [ -x "$root/usr/bin/jostle" ] || { tail -20 "$dir/log"; exit 1; }
inside() { in_root "$root" sh -c "$1" >"$dir/said" 2>&1; }
inside 'cd /tmp && jostle run running-through --steps 20 --summary - --quiet' && grep -q '"hash"' "$dir/said"
verdict "the program runs a scene by its name" $?
inside 'cd /tmp && jostle new scene mine && jostle check .'
verdict "a new scene is checked" $? ; head -5 "$dir/said"
inside 'cd /tmp && gcc /packages/embed.c $(pkg-config --cflags --libs jostle) -lm -o embed && ./embed'
verdict "a program with the library" $? ; tail -3 "$dir/said"
inside 'cd /tmp && python3 -c "
import jostle
scene = jostle.Scene(\"/usr/share/jostle/scenes/circle.yaml\", seed=2)
for _ in range(10): scene.step()
assert len(scene[\"x\"]) == len(scene) > 0 and abs(scene.time - 0.5) < 1e-9
"'
verdict "the Python package" $? ; tail -3 "$dir/said"
inside 'cd /tmp && lua5.4 -e "print(require([[jostle]]).scene([[/usr/share/jostle/scenes/circle.yaml]]):step(10):time())"' && grep -q '^0.5' "$dir/said"
verdict "the module of Lua" $? ; tail -3 "$dir/said"
inside 'apt-get purge -y -q jostle lua-jostle python3-jostle libjostle-dev libjostle0 libjostle-tools0 jostle-data jostle-doc && ! ls -d /usr/share/jostle'
verdict "they leave nothing behind" $? ; head -8 "$dir/said"
exit $failed
