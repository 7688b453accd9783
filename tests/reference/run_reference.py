#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Runs one reference input and compares the result file with the reference program's results, to 1 %.

Exit status: 0 agrees, 1 differs or failed, 77 reference data not present (in CI that is 1).
"""
import argparse
import json
import os
import pathlib
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
    args = parser.parse_args()
    shared = shared_folder(args.source)

    result = args.work / f"{args.case}.json"
    result.unlink(missing_ok=True)
    run = subprocess.run(
        [args.program, "run", shared / "data" / (args.input or pathlib.Path("contact_examples", f"{args.case}.inp")), "--json", result, "--quiet"],
        stdout=subprocess.DEVNULL)
    doubts = {remark["name"] for case in json.loads(result.read_text())["cases"] for remark in case["remarks"]
              if remark["grave"]} if run.returncode == 1 else set()
    if run.returncode not in (0, 4) and doubts != {args.doubts}:
        print(f"the program ended with status {run.returncode}")
        return 1
    cases = json.loads((shared / "reference" / f"{args.case}.json").read_text())
    reference = args.work / f"{args.case}.reference.json"
    reference.write_text(json.dumps(without(cases["cases"] if isinstance(cases, dict) else cases, args.wrong)))
    compare = subprocess.run([sys.executable, shared / "tools" / "compare_results.py", result, reference, "--rtol", "0.01"])
    return 1 if compare.returncode or run.returncode == 4 else 0


if __name__ == "__main__":
    sys.exit(main())
