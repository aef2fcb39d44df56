# tests/wheel/run.sh [root]: makes a wheel, installs it into a virtual environment without a compiler in reach, or with "root" into
# a new root folder that has Python, NumPy and cffi alone, and runs scenes there (inside.py).
set -u
where=${1-here}
cd "$(dirname "$0")/../.."
export MAKEFLAGS=
B=${B:-build/release}
JOSTLE=${JOSTLE:-$B/jostle}
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
verdict() { if [ "$2" = 0 ]; then echo "ok $1"; else echo "not ok $1"; fi; }
hash_of() { "$JOSTLE" run "scenes/$1.yaml" --no-mods --for 10 --quiet --summary - 2>/dev/null | sed -n 's/^ "hash": "\(.*\)",$/\1/p'; }

make -s wheel >"$dir/log" 2>&1; verdict "the wheel is made" $?
wheel=$PWD/$(sed -n 's/^\(.*\.whl\)  .*/\1/p' "$dir/log"); [ -f "$wheel" ] || { tail -5 "$dir/log"; exit 1; }
glibc=$(getconf GNU_LIBC_VERSION | sed 's/glibc //; s/\./_/')
case $wheel in *-py3-none-manylinux_"$glibc"_"$(uname -m)".whl) verdict "the tag names this system's glibc" 0 ;; *) verdict "the tag of $wheel" 1 ;; esac
mkdir "$dir/again"
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null)} /usr/bin/python3 scripts/python/wheel.py build/wheel "${PAGE:-build/page}" "$dir/again" >"$dir/log" 2>&1 &&
    cmp "$wheel" "$dir/again"/*.whl
verdict "a second wheel has the same bytes" $?
/usr/bin/python3 -m zipfile -l "$wheel" >"$dir/list"
grep -q 'licenses/bullet.txt' "$dir/list" && grep -q 'licenses/BUNDLED.txt' "$dir/list" && grep -q 'licenses/LICENSE' "$dir/list"
verdict "it has the licences of what is inside" $?

evacuation=$(hash_of evacuation) dodgeball=$(hash_of dodgeball)
if [ "$where" = here ]; then
    mkdir "$dir/bin"
    env -i PATH="$dir/bin" HOME="$dir" LC_ALL=C.UTF-8 /usr/bin/python3 tests/wheel/inside.py "$wheel" "$evacuation" "$dodgeball"
elif [ "$(id -u)" != 0 ]; then
    echo "ok a new root (left out: only root makes one)"
else
    . tests/deb/root.sh
    root=$dir/root
    make_root "$root" python3,python3-venv,python3-numpy,python3-cffi "mkdir \"\$1/wheel\" && cp '$wheel' tests/wheel/inside.py \"\$1/wheel\"" >"$dir/log" 2>&1
    verdict "a new root" $? ; [ -x "$root/usr/bin/python3" ] || { tail -20 "$dir/log"; exit 1; }
    in_root "$root" python3 /wheel/inside.py "/wheel/$(basename "$wheel")" "$evacuation" "$dodgeball"
fi
