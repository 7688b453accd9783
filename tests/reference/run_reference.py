#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Runs one reference input and compares the result file with the reference program's results.

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


def keys_without(quantity):
    """All that the comparison knows but one; nothing means all."""
    if not quantity:
        return ""
    keys = ["fn_N", "fx_N", "fs_N", "mn_Nmm", "approach_mm", "pmax_MPa", "elastic_energy_J", "frictional_power_W", "frictional_work_J",
            "xi", "eta", "fx_rel", "fs_rel", "kinematics.xi", "kinematics.eta", "kinematics.phi", "elements.ncon", "elements.nadh"]
    return ",".join(k for k in keys if k != quantity)


def main():
    parser = common_parser(__doc__)
    parser.add_argument("case")
    parser.add_argument("tolerance")
    parser.add_argument("--input", type=pathlib.Path, help="input file within the data folder; by default the example of that name")
    parser.add_argument("--doubts", default="", help="the only doubt that a result may have; the comparison goes on")
    parser.add_argument("--without", default="", help="a quantity of patches that is not compared")
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
    compare = subprocess.run(
        [sys.executable, shared / "tools" / "compare_results.py", result, shared / "reference" / f"{args.case}.json",
         "--rtol", args.tolerance, "--keys", keys_without(args.without)])
    return 1 if compare.returncode or run.returncode == 4 else 0


if __name__ == "__main__":
    sys.exit(main())
