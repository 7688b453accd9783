#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""How noise and smoothing trade: virtual scans of the wheel of examples/wheel-flat.toml, imported and run.

usage: scan-study.py PROGRAM [--points N] [--noise-um A,B,...] [--significance A,B,...]

Prints a Markdown table: error of axle, section, largest pressure and place of the patch against the formula, at four pitch
angles. The rows of docs/scans.md come from here.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PITCHES = [-9, -4, 0, 5]


def call(*arguments):
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, arguments))}\n{done.stderr}")


def case_text(wheel):
    """The example with four angles; wheel: a file, or None for the formula."""
    text = (ROOT / "examples" / "wheel-flat.toml").read_text()
    head, rest = text.split("[[cases]]", 1)
    if wheel:
        begin, end = head.index("[wheel]"), head.index("[rail]")
        head = head[:begin] + f'[wheel]\nshape.file = "{wheel}"\n\n' + head[end:]
    return head + f"[[cases]]\nwheelset.pitch_deg = {PITCHES}\n"


def largest(case):
    return max(case["patches"], key=lambda patch: patch["fn_N"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--points", type=int, default=1_000_000)
    parser.add_argument("--noise-um", default="10,30,100")
    parser.add_argument("--significance", default="0.5,1,2")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        program = pathlib.Path(arguments.program).resolve()

        def run(name, wheel):
            (folder / f"{name}.toml").write_text(case_text(wheel))
            call(program, "run", folder / f"{name}.toml", "--json", folder / f"{name}.json")
            return json.loads((folder / f"{name}.json").read_text())["cases"]

        truth = run("truth", None)
        print("| noise | significance | axle | section from nominal | pmax, largest error | position | slices |")
        print("|---|---|---|---|---|---|---|")
        for noise in arguments.noise_um.split(","):
            cloud = folder / "scan.ply"
            call(program, "scan", ROOT / "examples" / "wheel-flat.toml", "--body", "wheel", "-o", cloud, "--points", arguments.points,
                 "--noise-mm", float(noise) / 1e3, "--outliers", 0.01, "--holes", 0.02, "--frame", "random", "--seed", 7,
                 "--truth", folder / "scan.json")
            pose = json.loads((folder / "scan.json").read_text())["surface_in_cloud"]
            for significance in arguments.significance.split(","):
                call(program, "import", cloud, "-o", folder / "wheel.slcw", "--json", folder / "import.json", "--nominal-radius", 490,
                     "--set", f"fit.significance={significance}", "--set", "fit.follow=false")
                audit = json.loads((folder / "import.json").read_text())
                apart = [a - b for a, b in zip(audit["frame"]["origin_mm"], pose["origin_mm"])]
                along = sum(a * b for a, b in zip(apart, pose["y_axis"]))
                axle = math.sqrt(max(0.0, sum(a * a for a in apart) - along * along))
                found = run("found", folder / "wheel.slcw")
                pressure = place = 0.0
                for wanted, got in zip(truth, found):
                    a, b = largest(wanted), largest(got)
                    pressure = max(pressure, abs(b["pmax_MPa"] / a["pmax_MPa"] - 1))
                    place = max(place, math.hypot(*(b["reference"][k] - a["reference"][k] for k in ("x_tr_mm", "y_tr_mm"))))
                slices = audit["outputs"][0]["details"].split()[0]
                section = audit["frame"]["match_residual_mm"]
                print(f"| {noise} um | {significance} | {1e3 * axle:.2g} um | {1e3 * section:.2g} um | {100 * pressure:.1f} % | {place:.2f} mm | {slices} |", flush=True)


if __name__ == "__main__":
    main()
