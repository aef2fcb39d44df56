#!/bin/bash
# Times all named scenes and appends what came out to tests/bench/results/MODEL.csv, one file for each model of
# processor, with the commit. ROUNDS and ARGS (names of scenes, --steps) and ISA (default: avx2) may be set.
set -eu
cd "$(dirname "$0")/../.."
B=${B:-build/release}
model=$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | head -1 | tr -cs 'A-Za-z0-9\n' '-' | sed 's/-$//')
commit=$(git rev-parse --short HEAD)
git diff --quiet HEAD -- core behaviours scenes scripts || commit=$commit+
all="tawaf two-bottlenecks two-bottlenecks-full wall-breaking office dodgeball-500 running-through circle one-way-3 one-way-6
     counterflow-3 counterflow-6 arena scale-1k scale-10k scale-100k"
"$B/jostle" bench ${ARGS:-$all} --isa "${ISA:-avx2}" --rounds "${ROUNDS:-3}" --commit "$commit" --csv "tests/bench/results/${model:-unknown}.csv" \
    --plot "$B/bench-plot"
