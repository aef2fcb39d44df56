#!/bin/bash
# tests/fuzz/replay.sh NAME: gives a target its seeds, what fuzzing found in the past, and a few mutations of
# each, the same every time; for builds with sanitizers but without libFuzzer. Prints "ok NAME: N inputs".
set -u
cd "$(dirname "$0")/../.."
B=${B:-build/asan}
. tests/fuzz/seeds.sh
name=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
seeds "$name" "$work/seeds" || exit 1
if said=$("$B/fuzz/$name" --mutate "${MUTATIONS:-3}" "$work/seeds" 2>"$work/err"); then
    echo "ok $name: $(tail -1 <<<"$said")"
else
    echo "not ok $name"
    tail -30 "$work/err"
    exit 1
fi
