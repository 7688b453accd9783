#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Runs one reference input and compares the result file with the reference program's results, as closely as the row of the
case in docs/verification.md says, and as many numbers.

Exit status: 0 agrees, 1 differs or failed, 77 reference data not present (in CI that is 1).
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys


def common_parser(description):
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--program", required=True)
    parser.add_argument("--source", required=True, type=pathlib.Path)
    parser.add_argument("--work", required=True, type=pathlib.Path)
    return parser


def shared_folder(source):
    """The folder of the reference data; ends the program as skipped, in CI as failed, where there is none."""
    shared = pathlib.Path(os.environ.get("TREADMARK_SHARED", source.parent / "shared"))
    if not (shared / "data").is_dir():
        print(f"reference data not found in {shared}")
        sys.exit(1 if os.environ.get("CI") == "true" else 77)
    return shared


def claim_of(source, case):
    """Of the page: numbers, relative tolerance; how many of them may be further off, and how far."""
    page = (source / "docs" / "verification.md").read_text()
    row = re.search(rf"^\| `{case}` \| (\d+) \| ([\d.]+) % \| (?:(\d+) within ([\d.]+) % )?\|$", page, re.MULTILINE)
    if not row:
        sys.exit(f"docs/verification.md has no row for {case}")
    numbers, within, others, others_within = row.groups()
    return int(numbers), 0.01 * float(within), int(others or 0), 0.01 * float(others_within or within)


def compared(shared, result, reference, rtol):
    """Numbers that agree, all numbers, numbers that are missing."""
    text = subprocess.run([sys.executable, shared / "tools" / "compare_results.py", result, reference, "--rtol", str(rtol)],
                          stdout=subprocess.PIPE, text=True).stdout
    print(text, end="")
    return [int(n) for n in re.search(r"(\d+) of (\d+) numbers within tolerance, (\d+) missing", text).groups()]


def numbers_of(case, quantity):
    """The tables of a case in which a quantity stands, with its name there."""
    *path, name = quantity.split(".")
    tables = [case] if path and path[0] in ("wheelset", "force_on_rail") else case["patches"]
    for key in path:
        tables = [table[key] for table in tables]
    return [(table, name) for table in tables]


def without(cases, wrong):
    """The reference's cases but for numbers that are wrong there: "2,4-6:mn_Nmm"; one that is not there is an error."""
    for entry in wrong:
        numbers, quantity = entry.split(":")
        for part in numbers.split(","):
            first, _, last = part.partition("-")
            for number in range(int(first), int(last or first) + 1):
                case = next(c for c in cases if c["case"] == number)
                for table, name in numbers_of(case, quantity):
                    del table[name]
    return cases


def main():
    parser = common_parser(__doc__)
    parser.add_argument("case")
    parser.add_argument("--input", type=pathlib.Path, help="input file within the data folder; by default the example of that name")
    parser.add_argument("--doubts", default="", help="the only doubt that a result may have; the comparison goes on")
    parser.add_argument("--wrong", nargs="*", default=[], metavar="CASES:QUANTITY",
                        help="numbers of the reference that are wrong, with the proof in docs/contact-input.md")
    parser.add_argument("--changed", metavar="KEY=VALUE", help="runs with a key changed, which the comparison has to notice")
    args = parser.parse_args()
    shared = shared_folder(args.source)
    numbers, within, others, others_within = claim_of(args.source, args.case)

    result = args.work / f"{args.case}{'_changed' if args.changed else ''}.json"
    result.unlink(missing_ok=True)
    run = subprocess.run(
        [args.program, "run", shared / "data" / (args.input or pathlib.Path("contact_examples", f"{args.case}.inp")), "--json", result, "--quiet",
         *(["--set", args.changed] if args.changed else [])], stdout=subprocess.DEVNULL)
    doubts = {remark["name"] for case in json.loads(result.read_text())["cases"] for remark in case["remarks"]
              if remark["grave"]} if run.returncode == 1 else set()
    if run.returncode not in (0, 4) and doubts != {args.doubts}:
        print(f"the program ended with status {run.returncode}")
        return 1
    cases = json.loads((shared / "reference" / f"{args.case}.json").read_text())
    reference = result.with_suffix(".reference.json")
    reference.write_text(json.dumps(without(cases["cases"] if isinstance(cases, dict) else cases, args.wrong)))
    agree, all_numbers, missing = compared(shared, result, reference, within)
    agrees = missing == 0 and all_numbers == numbers and agree >= numbers - others
    if agrees and others > 0:
        agrees = compared(shared, result, reference, others_within)[0] == numbers
    if args.changed:
        return 0 if missing == 0 and not agrees else 1
    return 0 if agrees and run.returncode != 4 else 1


if __name__ == "__main__":
    sys.exit(main())
