#!/usr/bin/env python3
"""What a constant of the walking law moves: a Markdown table of the changes, in percent, of one figure of each of
eight quick claims about real crowds, where the constant is 20 % greater and 20 % less than its default.

    tests/bench/sensitivity.py [--program PATH] [--seed N] [--jobs N] [--out DIR] [CONSTANT...]

Without constants: all of them. Runs that are in DIR already are not done again.
"""
import argparse
import json
import pathlib
import subprocess
import sys

FIGURES = [  # claim, its figure, heading
    ("B1", "flow", "B1 flow"), ("B2", "b070", "B2 flow"), ("B4", "flow", "B4 flow"),
    ("C1", "speed before", "C1 speed"), ("F1", "d128", "F1 speed"), ("F2", "d171", "F2 speed"),
    ("F3b", "speed 180-180-095", "F3b speed"), ("L1", "speed", "L1 speed"),
]
SHARE = 0.2


def defaults(program):
    """{name: number} of all constants of the law."""
    schema = subprocess.run([program, "reference", "scene-schema"], capture_output=True, text=True, check=True).stdout
    return {name: about["default"] for name, about in json.loads(schema)["definitions"]["walking"]["properties"].items()}


def measure(options, change):
    """{(claim, figure): mean} with the given changes of constants, {} for none."""
    name = "-".join(f"{constant}={value:.6g}" for constant, value in change.items()) or "as-it-is"
    folder = pathlib.Path(options.out) / name
    command = [options.program, "reproduce", *[claim for claim, _, _ in FIGURES], "--quick", "--quiet",
               "--seeds", str(options.seed), "--jobs", str(options.jobs), "--out", str(folder)]
    for constant, value in change.items():
        command += ["--set", f"walking.{constant}={value:.6g}"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode > 1:  # 1: a claim misses, as it may
        sys.exit(f"{' '.join(command)}\n{done.stdout}{done.stderr}")
    results = json.loads((folder / "results.json").read_text())
    return {(claim, figure): results[claim]["figures"][figure]["mean"] for claim, figure, _ in FIGURES}


def percent(new, old):
    change = round(100 * (new / old - 1))
    return f"{change:+d}" if change else "0"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/release/jostle")
    parser.add_argument("--seed", type=int, default=101)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--out", default="build/out/sensitivity")
    parser.add_argument("constants", nargs="*")
    options = parser.parse_args()
    known = defaults(options.program)
    for constant in options.constants:
        if constant not in known:
            sys.exit(f"{constant} is no constant of the walking law: {', '.join(known)}")
    base = measure(options, {})
    print("| constant | " + " | ".join(heading for _, _, heading in FIGURES) + " |")
    print("|---" * (len(FIGURES) + 1) + "|", flush=True)
    for constant in options.constants or known:
        both = [measure(options, {constant: known[constant] * by}) for by in (1 + SHARE, 1 - SHARE)]
        cells = [" / ".join(percent(one[claim, figure], base[claim, figure]) for one in both)
                 for claim, figure, _ in FIGURES]
        print(f"| `{constant}` | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
