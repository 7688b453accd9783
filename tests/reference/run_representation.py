#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Runs one reference input with the wheel in another representation and compares with the reference program's results.

The greatest pressure of every patch must lie within --pmax-rtol of the reference's, everything else within --rtol as
tools/compare_results.py counts it (a force against the greatest force, positions within hundredths of a millimetre).
Exit status: 0 agrees, 1 differs or failed, 77 reference data not present (in CI that is 1).
"""
import json
import subprocess
import sys

from run_reference import common_parser, shared_folder

OTHERS = ("wheelset.z_mm", "force_on_rail.fx_tr_N", "force_on_rail.fy_tr_N", "force_on_rail.fz_tr_N", "reference.x_tr_mm",
          "reference.y_tr_mm", "reference.z_tr_mm", "reference.angle_rad", "fn_N", "fx_N", "fs_N", "mn_Nmm", "approach_mm")


def worst_pressure(ours, reference):
    """Greatest relative difference of pmax over all patches; None if cases or patches are missing."""
    found = {case["case"]: case["patches"] for case in ours["cases"]}
    worst = 0.0
    for case in reference["cases"] if isinstance(reference, dict) else reference:
        patches = found.get(case["case"], [])
        if len(patches) != len(case["patches"]):
            return None
        for patch, expected in zip(patches, case["patches"]):
            worst = max(worst, abs(patch["pmax_MPa"] / expected["pmax_MPa"] - 1.0))
    return worst


def main():
    parser = common_parser(__doc__)
    parser.add_argument("--resolution", required=True, help="[mm]")
    parser.add_argument("--rtol", default="0.01")
    parser.add_argument("--pmax-rtol", type=float, default=0.03)
    parser.add_argument("case")
    parser.add_argument("backend")
    args = parser.parse_args()
    shared = shared_folder(args.source)

    result = args.work / f"{args.case}_{args.backend}.json"
    result.unlink(missing_ok=True)
    run = subprocess.run(
        [args.program, "run", shared / "data" / "contact_examples" / f"{args.case}.inp", "--json", result, "--quiet",
         "--wheel-backend", args.backend, "--resolution", args.resolution], stdout=subprocess.DEVNULL)
    if run.returncode != 0:
        print(f"the program ended with status {run.returncode}")
        return 1
    ours = json.loads(result.read_text())
    used = [surface["backend"] for surface in ours["surfaces"] if surface["body"] == "wheel"]
    if used != [args.backend]:
        print(f"the wheel was represented as {used}")
        return 1
    reference = shared / "reference" / f"{args.case}.json"
    worst = worst_pressure(ours, json.loads(reference.read_text()))
    print("cases or patches are missing" if worst is None else f"greatest difference of pmax: {100 * worst:.2f} %")
    compare = subprocess.run([sys.executable, shared / "tools" / "compare_results.py", result, reference, "--rtol", args.rtol,
                              "--keys", ",".join(OTHERS)])
    return 0 if compare.returncode == 0 and worst is not None and worst <= args.pmax_rtol else 1


if __name__ == "__main__":
    sys.exit(main())
