#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Largest forces of a wheel flat by flat, track and speed: the table of docs/vehicle-simulation.md.

usage: flat-forces.py [PROGRAM] [--write | --check] [--only FLAT/TRACK ...] [--speeds V ...]     default build/release/app/treadmark

Runs examples/flat-at-speed.toml over one passage, upright and canted, and prints the rows; --write puts them into the page;
--check compares with the page instead, to 1 %, and the generated flat at 60 m/s with the levels that were published for the measured
one, to 2 %; exit status 1 where something differs. --only: some rows, as generated/zhai-equivalent. The measured flat
is looked for in ../shared or $TREADMARK_SHARED and left out where it is not there; where nothing is left, the exit status is 77,
in CI 1.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/vehicle-simulation.md"
SPEEDS, CANTS = (10, 40, 60), (0.0, 0.025)
FLATS, TRACKS = ("generated", "measured"), ("zhai-equivalent", "zhai-fitted", "zhai-flexible")
SLICES = pathlib.Path(os.environ.get("TREADMARK_SHARED", ROOT.parent / "shared")) / "data/contact_examples/S1002_flat.slcw"
SAME, PUBLISHED_SAME = 0.01, 0.02
# "Detailed Contact Geometry Processing for 3D Wheel and Rail Surfaces": upright and canted 1:40 at 60 m/s [kN].
PUBLISHED = {60: (364.0, 462.0)}


def force(program, folder, flat, track, speed, cant):
    """Largest vertical force of the first passage [kN]."""
    keys = [f"simulation.speed_m_s={speed}", "simulation.distance_m=1.6", "simulation.max_step_elements=2", f"track.cant_rad={cant}",
            f"simulation.track=tracks/{track}.toml"]
    if flat == "measured":  # as scripts/figures.sh does; its angle is that at which it is down
        keys += [f"wheel.shape.file={SLICES}", "wheel.shape.smoothing_lambda_mm3=5", "wheel.flats=[]",
                 "simulation.other_wheel.shape.standard=S1002", "simulation.wheels.0.pitch_deg=22.8"]
    summary = pathlib.Path(folder) / f"{flat}-{track}-{speed}-{cant}.json"
    run = subprocess.run([program, "simulate", ROOT / "examples/flat-at-speed.toml", "--threads", "1", "--quiet", "--json", summary,
                          *[word for key in keys for word in ("--set", key)]], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if run.returncode:
        sys.exit(f"{flat}, {track}, {speed} m/s, cant {cant}: status {run.returncode}\n{run.stderr}")
    return 1e-3 * json.loads(summary.read_text())["summary"]["q_max_N"]


def page_rows(text):
    """Of the table: (flat, track) and place of the line and forces by speed and cant."""
    rows, flat = {}, ""
    for match in re.finditer(r"^\| (generated|measured)?[^|]*\| `(zhai-\w+)`[^|]*\|((?: \d+, \d+ \|){3})$", text, re.MULTILINE):
        flat = match[1] or flat
        values = [float(n) for n in re.findall(r"\d+", match[3])]
        rows[flat, match[2]] = (match.span(3), {(v, c): values[2 * i + j] for i, v in enumerate(SPEEDS) for j, c in enumerate(CANTS)})
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=ROOT / "build/release/app/treadmark", type=pathlib.Path)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--only", nargs="*", default=[f"{flat}/{track}" for flat in FLATS for track in TRACKS])
    parser.add_argument("--speeds", nargs="*", type=int, choices=SPEEDS, default=SPEEDS)
    options = parser.parse_args()
    if options.write and list(options.speeds) != list(SPEEDS):
        parser.error("rows are written whole")
    text = PAGE.read_text()
    known = page_rows(text)
    wanted = [tuple(name.split("/")) for name in options.only]
    if unknown := [name for name in wanted if name not in known]:
        sys.exit(f"{PAGE.name} has no row for {unknown}")
    if not SLICES.exists():
        wanted = [(flat, track) for flat, track in wanted if flat != "measured"]
        if not wanted:
            print(f"no file {SLICES}")
            return 1 if os.environ.get("CI") == "true" else 77
    program = options.program.resolve()
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        runs = {(row, v, c): pool.submit(force, program, folder, *row, v, c) for row in wanted for v in options.speeds for c in CANTS}
        found = {key: run.result() for key, run in runs.items()}

    differs = False
    for row in wanted:
        for v in options.speeds:
            for i, c in enumerate(CANTS):
                ours, page = found[row, v, c], known[row][1][v, c]
                compared = [(page, SAME, "the page")]
                if row == ("generated", "zhai-equivalent") and v in PUBLISHED:
                    compared.append((PUBLISHED[v][i], PUBLISHED_SAME, "the publication"))
                for other, share, name in compared:
                    off = ours / other - 1.0
                    differs |= abs(off) > share
                    print(f"{'/'.join(row)}, {v} m/s, {'1:40' if c else 'upright'}: {ours:.1f} kN, {name} {other:.0f}, {100 * off:+.2f} %"
                          + ("  DIFFERS" if abs(off) > share else ""))
    if options.write:
        for row in sorted(wanted, key=lambda row: known[row][0], reverse=True):
            begin, end = known[row][0]
            cells = "".join(f" {found[row, v, CANTS[0]]:.0f}, {found[row, v, CANTS[1]]:.0f} |" for v in SPEEDS)
            text = text[:begin] + cells + text[end:]
        PAGE.write_text(text)
    return 1 if options.check and differs else 0


if __name__ == "__main__":
    sys.exit(main())
