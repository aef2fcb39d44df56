#!/bin/bash
# scripts/wasm/sources.sh FOLDER PACKAGE...: unpacks the sources of Debian packages, with Debian's patches, as FOLDER/PACKAGE.
# Downloads those that FOLDER/download lacks by apt-get, with an index of source packages of its own: the system's list
# of sources stays as it is. JOSTLE_SOURCES names a folder with downloads, for machines without a network.
set -eu
folder=$1; shift
download=$folder/download apt=$folder/apt
mkdir -p "$download"
[ -z "${JOSTLE_SOURCES-}" ] || cp -n "$JOSTLE_SOURCES"/*.dsc "$JOSTLE_SOURCES"/*.tar.* "$download"

apt_get() {
    apt-get -q -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$apt/parts" \
        -o Dir::State::Lists="$apt/lists" -o APT::Sandbox::User=root "$@" >"$apt/log" 2>&1
}
# Makes the index, once, from the addresses of the system's own list.
make_index() {
    [ -e "$apt/done" ] && return
    mkdir -p "$apt/parts" "$apt/lists/partial"
    apt=$(cd "$apt" && pwd)
    sed -s 's/^Types:.*/Types: deb-src/' /etc/apt/sources.list.d/*.sources >"$apt/parts/source.sources" 2>/dev/null || true
    sed -n 's/^deb /deb-src /p' /etc/apt/sources.list >"$apt/parts/source.list" 2>/dev/null || true
    apt_get update || { cat "$apt/log" >&2; exit 1; }
    touch "$apt/done"
}
fetch() { # PACKAGE
    make_index
    apt=$(cd "$apt" && pwd)
    local release; release=$(. /etc/os-release && echo "${VERSION_CODENAME:-stable}")
    # The newest version may have left the archive of security updates; that of the release stays.
    (cd "$download" && apt_get source --download-only "$1" || apt_get source --download-only "$1/$release") ||
        { cat "$apt/log" >&2; exit 1; }
}
for package in "$@"; do
    [ -e "$folder/$package/.unpacked" ] && continue
    ls "$download/${package}"_*.dsc >/dev/null 2>&1 || fetch "$package"
    rm -rf "${folder:?}/$package"
    dpkg-source --no-check -x "$(ls -v "$download/${package}"_*.dsc | tail -n 1)" "$folder/$package" >"$download/$package.log" 2>&1 ||
        { cat "$download/$package.log" >&2; exit 1; }
    touch "$folder/$package/.unpacked"
done
