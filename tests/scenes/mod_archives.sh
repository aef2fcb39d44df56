# Mods as zip archives: found, named, turned on, checked and reloaded as folders are; refused where an archive is unsafe.
. tests/scenes/lib.sh
program=$(case $JOSTLE in /*) echo "$JOSTLE" ;; *) echo "$PWD/$JOSTLE" ;; esac)
tree=$work/tree
mkdir -p "$tree/behaviours" "$tree/scenes/mods"
cp -R scripts "$tree/"
cp behaviours/stander.lua "$tree/behaviours/"
cd "$tree" || exit 1
pid=
trap '[ -z "$pid" ] || kill -KILL $pid; rm -rf "$work"' EXIT
printf 'jostle: 1\nplaces: {goal: {point: [9, 0]}}\ngroups: {g: {behaviour: stander.lua, at: [[0, 0], [2, 0]]}}\n' >scenes/yard.yaml
source=$work/source
mkdir -p "$source/patches" "$source/behaviours"
printf 'name: alpha\nversion: 1.0\napi: 1\nsettings: {reach: {value: 3}}\n' >"$source/mod.yaml"
echo 'return { wide = 0.25 }' >"$source/behaviours/wide.lua"
patch() { printf 'local wide = require("alpha:wide").wide\nreturn patch "stander" { defaults = { %s } }\n' "$1" >"$source/patches/stander.lua"; }
patch 'radius = wide, perception = settings.reach'
# pack FILE SCRIPT: makes an archive by Python, of the mod and what the script adds to the archive z
pack() {
    python3 - "$source" "$1.new" "$2" <<'END' && mv "$1.new" "$1"
import os, stat, sys, warnings, zipfile
warnings.simplefilter("ignore")
source, to, script = sys.argv[1:]
with zipfile.ZipFile(to, "w", zipfile.ZIP_DEFLATED) as z:
    top = ""
    def add(top=""):
        for folder, _, names in sorted(os.walk(source)):
            for name in sorted(names):
                path = os.path.join(folder, name)
                z.write(path, top + os.path.relpath(path, source))
    def link(name, target):
        info = zipfile.ZipInfo(name)
        info.create_system = 3
        info.external_attr = (stat.S_IFLNK | 0o777) << 16
        z.writestr(info, target)
    exec(script)
END
}
# damage FILE ENTRY: changes a byte of the content of an entry
damage() {
    python3 - "$@" <<'END'
import sys, zipfile
path, name = sys.argv[1:]
with zipfile.ZipFile(path) as z:
    head = z.getinfo(name).header_offset
data = bytearray(open(path, "rb").read())
data[head + 30 + len(name) + 4] ^= 0xff
open(path, "wb").write(data)
END
}
run=("$program" run scenes/yard.yaml --steps 1 --quiet)
if ldd "$program" | grep -q libzip; then
    cp -R "$source" scenes/mods/alpha
    of_folder=$("${run[@]}" --mod alpha --summary - 2>/dev/null | figure hash)
    rm -r scenes/mods/alpha
    pack scenes/mods/alpha.zip 'add()'
    expect "an archive in mods/ is found, and off" 0 "off: alpha 1.0 (scenes/mods/alpha.zip)" "$program" mod list scenes/yard.yaml
    same_hash "it does what the folder does" "$of_folder" "$("${run[@]}" --mod alpha --summary - 2>/dev/null | figure hash)"
    same_hash "  named by its path too" "$of_folder" "$("${run[@]}" --mod scenes/mods/alpha.zip --summary - 2>/dev/null | figure hash)"
    expect "its settings are set" 0 "perception of agent 0 at 0.00 s, in state Stand: 3" "$program" mod why perception scenes/yard.yaml --agent 0 --mod alpha
    expect "mod why names the file in it" 0 "scenes/mods/alpha.zip/patches/stander.lua:2:39: wide   (mod alpha 1.0)" "$program" mod why stander.defaults.radius scenes/yard.yaml --mod alpha
    expect "mod enable turns it on" 0 "is on" "$program" mod enable scenes/mods/alpha.zip
    expect "  and it is loaded" 0 "mods: alpha 1.0 (scenes/mods/alpha.zip)" "${run[@]}"
    pack scenes/mods/alpha.zip 'add(); z.writestr("patches/note.txt", "x")'
    expect "  until its content changes" 0 "warning: mod alpha has changed since it was turned on: it is off" "${run[@]}"
    pack scenes/mods/alpha.zip 'add()'
    "$program" mod disable scenes/mods/alpha.zip >/dev/null
    expect "mod check checks it" 0 "nothing wrong" "$program" mod check scenes/mods/alpha.zip
    pack scenes/mods/alpha.zip 'add("alpha-1.0/")'
    expect "an archive of one folder is found" 0 "off: alpha 1.0 (scenes/mods/alpha.zip/alpha-1.0)" "$program" mod list scenes/yard.yaml
    same_hash "  and does the same" "$of_folder" "$("${run[@]}" --mod scenes/mods/alpha.zip --summary - 2>/dev/null | figure hash)"
    mkdir -p scenes/mods/omega
    printf 'name: omega\nversion: 1.0\napi: 1\ndepends: [alpha]\n' >scenes/mods/omega/mod.yaml
    expect "a folder depends on an archive" 0 "mods: alpha 1.0 (scenes/mods/alpha.zip/alpha-1.0)" "${run[@]}" --mod alpha --mod omega
    rm -r scenes/mods/omega
    patch 'radios = 3'
    pack scenes/mods/alpha.zip 'add()'
    expect "an error has its place in the archive" 3 "scenes/mods/alpha.zip/patches/stander.lua:2:39: unknown key 'radios'. Did you mean 'radius'?" "${run[@]}" --mod alpha
    patch 'radius = wide'
    pack scenes/mods/alpha.zip 'add()'

    # Reload: an archive that is replaced by another.
    "$program" run scenes/yard.yaml --steps 900000000 --watch --quiet --mod alpha >"$work/said" 2>&1 </dev/null &
    pid=$!
    sleep 1
    says() { for i in $(seq 300); do grep -qF -- "$1" "$work/said" && return 0; sleep 0.02; done; tail -5 "$work/said"; return 1; }
    patch 'radius = 0.3'
    pack scenes/mods/alpha.zip 'add()'
    says "stander.lua: version 2 is live" || says "(reload 1) is live"; verdict "an archive that is replaced reloads the behaviour" $?
    patch 'radios = 3'
    pack scenes/mods/alpha.zip 'add()'
    says "alpha.zip/patches/stander.lua:2:39: unknown key 'radios'"; verdict "  unless it is wrong, which is said" $?
    echo junk >scenes/mods/alpha.zip
    says "cannot load 'scenes/mods/alpha.zip/patches/stander.lua': the archive cannot be used: it is no zip archive"; verdict "  or no archive at all" $?
    patch 'radius = 0.28'
    pack scenes/mods/alpha.zip 'add()'
    says "(reload 2) is live"; verdict "  and goes on with the next one" $?
    cp scenes/mods/alpha.zip scenes/mods/next
    damage scenes/mods/next patches/stander.lua && mv scenes/mods/next scenes/mods/alpha.zip
    says "cannot load 'scenes/mods/alpha.zip/patches/stander.lua': it is damaged in the archive: its checksum is wrong"; verdict "a damaged file in it is named" $?
    says "Version 1 (reload 2) keeps running"; verdict "  and the version that runs is kept" $?
    kill -INT $pid; wait $pid
    pid=
    # Archives that are refused, whole.
    refused() { # NAME TEXT SCRIPT
        pack bad.zip "add(); $3"
        expect "$1" 3 "bad.zip: cannot use 'bad.zip': $2" "${run[@]}" --mod bad.zip
    }
    refused "a path that leads out" "'../evil.lua': its path leads out of the archive, or is not portable" 'z.writestr("../evil.lua", "x")'
    refused "  from within" "'patches/../../evil.lua': its path leads out" 'z.writestr("patches/../../evil.lua", "x")'
    refused "  from the root" "'/etc/evil': its path leads out" 'z.writestr("/etc/evil", "x")'
    refused "  with a backslash" "'patches" 'z.writestr("patches\\\\evil.lua", "x")'
    refused "a symbolic link" "'patches/link.lua': symbolic links are not followed" 'link("patches/link.lua", "/etc/passwd")'
    refused "two entries of one name" "it has two files of one name" 'z.writestr("mod.yaml", "x")'
    refused "a bomb" "'patches/bomb.lua': it unpacks to over 200 times its size" 'z.writestr("patches/bomb.lua", b"0" * 9000000)'
    refused "a huge file" "'patches/huge.lua': it is too large" 'z.writestr("patches/huge.lua", b"0" * 17000000)'
    refused "much in all" "'patches/2.lua': the files before and with it are over 16 MB" 'z.compression = 0; import random; [z.writestr("patches/%d.lua" % n, random.Random(n).randbytes(20000) * 300, 8) for n in range(4)]'
    refused "too many files" "it has over 1000 files" '[z.writestr("patches/%d.txt" % n, "x") for n in range(1001)]'
    head -c 300 bad.zip >cut.zip
    expect "a cut archive" 3 "cut.zip: cannot use 'cut.zip': it is no zip archive" "${run[@]}" --mod cut.zip
    echo junk >junk.zip
    expect "no archive" 3 "junk.zip: cannot use 'junk.zip': it is no zip archive" "${run[@]}" --mod junk.zip
    pack bad.zip 'add()'
    damage bad.zip mod.yaml
    expect "damaged content" 3 "cannot read 'bad.zip/mod.yaml': it is damaged in the archive" "${run[@]}" --mod bad.zip
    head -c 9000000 /dev/urandom >large.zip
    expect "a huge archive" 3 "cannot use 'large.zip': it is over 8 MB" "${run[@]}" --mod large.zip
    expect "mod check says so too" 3 "cannot use the archive: it is no zip archive" "$program" mod check junk.zip
else
    pack scenes/mods/alpha.zip 'add()'
    expect "a build without libzip refuses archives" 3 "this Jostle was built without libzip" "${run[@]}" --mod scenes/mods/alpha.zip
fi
