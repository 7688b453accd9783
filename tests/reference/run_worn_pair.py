#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""A worn wheel in the gauge corner of a worn rail, conformal, on a contact plane of 66 degrees: three parts lie 60 mm
apart along the rail's section. The reference program gives 1820 MPa and 1600 elements.

Exit status: 0 agrees, 1 differs or failed, 77 reference data not present (in CI that is 1).
"""
import json
import shutil
import subprocess
import sys

from run_reference import common_parser, shared_folder

PRESSURE_MPA, PRESSURE_SHARE = 1820.0, 0.01
ELEMENTS, ELEMENTS_SHARE = 1600, 0.02


def main():
    args = common_parser(__doc__).parse_args()
    data = shared_folder(args.source) / "data"
    folder = args.work / "worn_pair"
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copy(data / "real" / "cases" / "conformal_worn_pair.inp", folder)
    for profile in ("site_b_hr.prr", "worn_high_mileage.prw"):
        shutil.copy(data / "contact_testbank" / "profiles" / profile, folder)
    result = folder / "result.json"
    result.unlink(missing_ok=True)
    run = subprocess.run([args.program, "run", folder / "conformal_worn_pair.inp", "--json", result, "--quiet"],
                         stdout=subprocess.DEVNULL)
    if run.returncode != 0:
        print(f"the program ended with status {run.returncode}")
        return 1
    patches = json.loads(result.read_text())["cases"][0]["patches"]
    pressure = max(p["pmax_MPa"] for p in patches)
    elements = sum(p["elements"]["ncon"] for p in patches)
    print(f"{len(patches)} patches, {pressure} MPa, {elements} elements")
    agrees = (len(patches) == 1 and abs(pressure - PRESSURE_MPA) <= PRESSURE_SHARE * PRESSURE_MPA
              and abs(elements - ELEMENTS) <= ELEMENTS_SHARE * ELEMENTS)
    return 0 if agrees else 1


if __name__ == "__main__":
    sys.exit(main())
