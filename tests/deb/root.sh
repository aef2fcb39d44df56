# make_root FOLDER PACKAGES HOOK...: makes a root folder of this Debian release that has only what apt needs, and PACKAGES (with
# commas). A HOOK is a command of the shell, run here with the folder as $1 once these are installed. For root alone.
make_root() {
    local folder=$1 packages=$2 lists hook sources=() hooks=()
    shift 2
    for hook in "$@"; do hooks+=("--customize-hook=$hook"); done
    lists=$(mktemp -d)
    cat /etc/apt/sources.list /etc/apt/sources.list.d/*.list 2>/dev/null >"$lists/sources.list"
    cat /etc/apt/sources.list.d/*.sources 2>/dev/null >"$lists/more.sources"
    for hook in "$lists"/*; do [ -s "$hook" ] && sources+=("$hook"); done
    . /etc/os-release
    mmdebstrap --quiet --mode=root --variant=apt --include="$packages" "${hooks[@]}" "$VERSION_CODENAME" "$folder" "${sources[@]}"
    local status=$?
    rm -rf "$lists"
    return $status
}
# in_root FOLDER COMMAND...: runs a command in it, with /proc and an environment of its own.
in_root() {
    unshare --mount sh -c 'mount --bind /proc "$1/proc"; root=$1; shift
        exec chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 "$@"' sh "$@"
}
