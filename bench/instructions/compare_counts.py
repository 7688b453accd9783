#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Compares counts of instructions with a baseline.

usage: compare_counts.py BASELINE COUNTS --configuration WORDS [--paths FILE] [--update]

COUNTS has a line a path: name, unit, units in one run, instructions of one run. BASELINE is a JSON file: counts a unit by
configuration (compiler, kernels, tool) and path. FILE has the names of all paths that there are, counted or not. Exit
status: 0 no count grew by more than 5 %, 1 one did, or a path of the baseline is gone, 3 there is no baseline of this
configuration. What fell by more than 5 % is named, so that it can be kept. --update writes the counts into the baseline,
takes out what is gone, and exits with 0.
"""
import argparse
import json
import pathlib
import sys

ALLOWED = 1.05


def read_counts(text):
    """(path, unit, instructions a unit) of every line, in the order of the names."""
    rows = []
    for line in text.splitlines():
        path, unit, units, instructions = line.split()
        rows.append((path, unit, int(instructions) / int(units)))
    return sorted(rows)


def digits(value):
    return f"{value:.1f}" if value < 1e4 else f"{value:.4g}"


def table(rows, known):
    """Lines of the table, the paths that grew, and those that fell."""
    width = max(len(path) for path, _, _ in rows)
    lines, grown, fallen = [f"{'path':{width}}  {'instructions':>13} per      {'baseline':>11}  ratio"], [], []
    for path, unit, count in rows:
        before = known.get(path)
        ratio = count / before if before else None
        mark = ""
        if ratio is not None and ratio > ALLOWED:
            grown.append(path)
            mark = "  GREW"
        elif ratio is not None and ratio < 1.0 / ALLOWED:
            fallen.append(path)
            mark = "  fell"
        lines.append(f"{path:{width}}  {digits(count):>13} {unit:8} {digits(before) if before else '-':>11}  "
                     f"{f'{ratio:.3f}' if ratio else 'new':>5}{mark}")
    return lines, grown, fallen


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("baseline", type=pathlib.Path)
    parser.add_argument("counts", type=pathlib.Path)
    parser.add_argument("--configuration", required=True)
    parser.add_argument("--paths", type=pathlib.Path)
    parser.add_argument("--update", action="store_true")
    options = parser.parse_args()

    baseline = json.loads(options.baseline.read_text()) if options.baseline.exists() else {}
    rows = read_counts(options.counts.read_text())
    known = baseline.get(options.configuration, {})
    lines, grown, fallen = table(rows, known)
    gone = sorted(set(known) - set(options.paths.read_text().split())) if options.paths else []
    print(options.configuration)
    print("\n".join(lines))
    if options.update:
        for path in gone:
            del known[path]
        known.update({path: round(count, 2) for path, _, count in rows})
        baseline[options.configuration] = dict(sorted(known.items()))
        options.baseline.write_text(json.dumps(baseline, indent=1) + "\n")
        print(f"written to {options.baseline}")
        return 0
    if not known:
        print(f"no baseline of this configuration in {options.baseline}: write one with --update on a version that is good",
              file=sys.stderr)
        return 3
    for path in grown:
        print(f"{path} grew by more than {100 * (ALLOWED - 1):.0f} %", file=sys.stderr)
    for path in gone:
        print(f"{path} is in the baseline, but not among the paths: count it again, or take it out with --update", file=sys.stderr)
    if fallen:
        print(f"fell by more than {100 * (ALLOWED - 1):.0f} %, which --update would keep: {', '.join(fallen)}", file=sys.stderr)
    return 1 if grown or gone else 0


if __name__ == "__main__":
    sys.exit(main())
