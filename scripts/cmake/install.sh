#!/bin/sh
# install.sh FOLDER PREFIX VERSION POINTER LIBS-OF-ENGINE LIBS-OF-TOOLS: writes the files by which CMake finds Jostle into FOLDER,
# which is LIBDIR/cmake/jostle below DESTDIR (from the environment). POINTER: size of a pointer, bytes. LIBS: flags of the linker.
# `make install` calls it.
set -eu
here=$(dirname "$0")
folder=$1 prefix=$2 version=$3 pointer=$4
to_prefix=$(realpath -m --relative-to="$folder" "${DESTDIR-}$prefix")
items_of() { echo "$1" | sed 's/ -pthread//g; s/^-l//; s/ -l/ /g'; }
mkdir -p "$folder"
for file in jostle-config jostle-config-version; do
    sed -e "s|@TO_PREFIX@|$to_prefix|; s|@VERSION@|$version|g; s|@POINTER@|$pointer|g" \
        -e "s|@LIBS_JOSTLE@|$(items_of "$5")|; s|@LIBS_TOOLS@|$(items_of "$6")|" "$here/$file.cmake.in" >"$folder/$file.cmake"
    chmod 644 "$folder/$file.cmake"
done
