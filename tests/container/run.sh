# tests/container/run.sh [BASE]: builds the image of scripts/container with Buildah, which needs no service, and uses it as a
# container's user does. BASE: image to build from; without it, and where no registry is reached, a root folder of this Debian
# release that mmdebstrap makes. Needs root. CCACHE: folder of a ccache to compile with.
set -u
cd "$(dirname "$0")/../.."
B=${B:-build/release}
JOSTLE=${JOSTLE:-$B/jostle}
dir=$(mktemp -d)
export STORAGE_DRIVER=vfs BUILDAH_ISOLATION=chroot
bud() { buildah --root "$dir/store" --runroot "$dir/run" "$@"; }
verdict() { if [ "$2" = 0 ]; then echo "ok $1"; else echo "not ok $1"; fi; }
server=
trap '[ -z "$server" ] || kill -- -$server 2>/dev/null; bud rm --all >/dev/null 2>&1; rm -rf "$dir"' EXIT

base=${1-debian:bookworm-slim}
if [ -f "$base" ] || ! bud pull -q "$base" >"$dir/log" 2>&1; then
    root=$base
    if [ ! -f "$base" ]; then
        [ $# = 0 ] || { verdict "the image $base" 1; tail -3 "$dir/log"; exit 1; }
        . tests/deb/root.sh
        root=$dir/base.tar
        make_root "$root" ca-certificates >"$dir/log" 2>&1 || { verdict "a root folder to build from" 1; tail -5 "$dir/log"; exit 1; }
        echo "    no registry is reached: built from Debian's packages instead"
    fi
    container=$(bud from scratch) && bud add -q "$container" "$root" / >/dev/null && bud commit -q "$container" localhost/debian >/dev/null
    verdict "an image to build from" $?
    bud rm "$container" >/dev/null; rm -f "$dir/base.tar"
    base=localhost/debian
fi
# The files of this commit and the page, as a source archive has them: a build in a container may not reach npm.
mkdir "$dir/source" && git archive HEAD | tar -x -C "$dir/source" && cp -R "${PAGE:-build/page}" "$dir/source/bundled"
options=()
if [ -n "${CCACHE-}" ]; then
    options=(--volume "$CCACHE:/ccache" --env CCACHE_DIR=/ccache --build-arg MORE=ccache --build-arg CC="ccache gcc" --build-arg CXX="ccache g++")
fi
bud build -q --build-arg BASE="$base" "${options[@]}" -t jostle -f scripts/container/Containerfile "$dir/source" >"$dir/log" 2>&1
built=$?; verdict "the image is built" $built; [ $built = 0 ] || { tail -15 "$dir/log"; exit 1; }

container=$(bud from jostle)
[ "$(bud inspect --format '{{.OCIv1.Config.Entrypoint}} {{.OCIv1.Config.User}}' "$container")" = "[jostle] jostle" ]
verdict "it runs the program, as a user of its own" $?
inside() { bud run "$container" -- jostle "$@" >"$dir/said" 2>&1; }
bud run "$container" -- id -un >"$dir/said" 2>&1; grep -qx jostle "$dir/said"; verdict "  who is not root" $? ; head -2 "$dir/said"
! bud run "$container" -- sh -c 'command -v gcc || command -v npm || ls -d /src' >"$dir/said" 2>&1
verdict "what built it is not in it" $? ; head -2 "$dir/said"
wanted=$("$JOSTLE" run scenes/evacuation.yaml --no-mods --for 10 --quiet --summary - | grep '^ "hash":')
inside run evacuation --for 10 --quiet --summary - && grep -qF -- "$wanted" "$dir/said"
verdict "a scene by its name, with the hash of the program here" $? ; tail -2 "$dir/said"
inside run dodgeball --for 2 --quiet --record run.sqlite && inside report run.sqlite --out report
verdict "a recording and its report, in /work" $? ; tail -3 "$dir/said"
# A group of processes of its own, which ends as a whole.
setsid buildah --root "$dir/store" --runroot "$dir/run" run "$container" -- \
    jostle run evacuation --view=8793 --view-address 0.0.0.0 --view-wait 60 >"$dir/view" 2>&1 &
server=$!
for _ in $(seq 100); do grep -q 'http://' "$dir/view" && break; sleep 0.2; done
address=$(grep -o 'http://[^ ]*' "$dir/view" | head -1 | sed 's|http://[^:/]*:|http://127.0.0.1:|')
curl -sSL --max-time 20 -c "$dir/cookies" "$address" 2>"$dir/said" | grep -qi '<html'
verdict "its live page is reached from outside" $? ; cat "$dir/said"; head -3 "$dir/view"
kill -- -$server; wait $server 2>/dev/null; server=
exit 0
