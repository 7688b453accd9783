#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Figures of a wheel flat in a vehicle (examples/figure5.toml, figure6.toml, figure7.toml) with their tables in docs/vehicle-simulation.md.

usage: flat-figures.py [PROGRAM] [--write] [--only FIGURE ...] [--out FOLDER]     default build/release/app/treadmark
       flat-figures.py --self-test

Runs the studies, prints the rows that follow from them and with --write puts rows and pictures into docs/. --out keeps results there, which
are then gone on from; a folder without --out is removed. --only: some figures, by their number. Rows without numbers yet have "...".
"""
import argparse
import collections
import csv
import io
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/vehicle-simulation.md"
LOW_SPEED = 12.0  # [m/s]: the published local maximum lies just below 10
PUBLISHED_AT = 60.0  # [m/s]: where levels were published


def named(text):
    """{"cant": "1:40", "track": "fitted"} of "cant = 1:40, track = fitted"."""
    return dict(part.split(" = ", 1) for part in text.split(", "))


def rows_of(text):
    return list(csv.DictReader(io.StringIO(text)))


def maxima(curve):
    """Places of a curve, (x, y) by x, that are higher than both neighbours."""
    return [i for i in range(1, len(curve) - 1) if curve[i - 1][1] < curve[i][1] > curve[i + 1][1]]


def by_speed(text):
    """Rows of figure6-speed.csv: of each track and cant the local maximum at low speed with the dip behind it, the highest force, and that at
    the speed of the publication with its ratio to that on upright rails."""
    curves = collections.defaultdict(list)
    for row in rows_of(text):
        if row["kind"] == "run":
            names = named(row["line"])
            curves[names["track"], names["cant"]].append((float(row["simulation.speed_m_s"]), 1e-3 * float(row["q_max_N"])))
    out = {}
    for (track, cant), curve in curves.items():
        curve.sort()
        top = max(curve, key=lambda at: at[1])
        low = [i for i in maxima(curve) if curve[i][0] <= LOW_SPEED and curve[i][0] < top[0]]
        local = "none"
        if low:
            peak = max(low, key=lambda i: curve[i][1])
            behind = min((at for at in curve[peak:] if at[0] < top[0]), key=lambda at: at[1])
            local = f"{curve[peak][1]:.0f} at {curve[peak][0]:g}, {behind[1]:.0f} at {behind[0]:g}"
        at_published = dict(curve).get(PUBLISHED_AT, math.nan)
        upright = dict(curves[track, "none"]).get(PUBLISHED_AT, math.nan)
        out[track, "upright" if cant == "none" else cant] = [
            local, f"{top[1]:.0f} at {top[0]:g}", f"{at_published:.0f}", "" if cant == "none" else f"{100.0 * (at_published / upright - 1.0):+.0f} %",
            f"{curve[-1][1]:.0f}"]
    return out


def by_theory(text):
    """Rows of figure5.csv: of each theory and grid the largest Q, and the least and largest T_y with the time of the least."""
    runs = collections.defaultdict(list)
    for row in rows_of(text):
        runs[row["run"]].append((1e3 * float(row["t_s"]), 1e-3 * float(row["Q_N"]), 1e-3 * float(row["Ty_N"])))
    out = {}
    for name, at in runs.items():
        q, least = max(at, key=lambda one: one[1]), min(at, key=lambda one: one[2])
        out[tuple(name.rsplit(", ", 1))] = [f"{q[1]:.1f} at {q[0]:.2f}", f"{least[2]:.1f} at {least[0]:.2f}", f"{max(one[2] for one in at):.1f}"]
    return out


def by_angle(text):
    """Rows of patches.csv: at each angle the middle of the contact and the largest pressure."""
    panels = collections.defaultdict(list)
    angles = {}
    for row in rows_of(text):
        angles[row["panel"]] = math.degrees(math.remainder(float(row["pitch_rad"]), 2.0 * math.pi))
        if row["kind"] == "pressure_Pa":
            panels[row["panel"]].append((float(row["x_m"]), float(row["y_m"]), float(row["value"])))
    out = {}
    for panel, angle in angles.items():
        cells = panels[panel]
        middle = [500.0 * (min(c[i] for c in cells) + max(c[i] for c in cells)) for i in (0, 1)] if cells else []
        out[(f"{angle:.1f}",)] = [f"{middle[0]:.1f}", f"{middle[1]:.1f}", f"{1e-6 * max(c[2] for c in cells):.0f}"] if cells else ["none"] * 3
    return out


Figure = collections.namedtuple("Figure", "verb table rows head keys pictures")
FIGURES = {
    5: Figure("sweep", "figure5.csv", by_theory, ["theory", "elements", "largest Q [kN] at [ms]", "least T_y [kN] at [ms]", "largest T_y [kN]"], 2,
              {"figure5.svg": "flat-passage.svg"}),
    6: Figure("sweep", "figure6-speed.csv", by_speed,
              ["track", "rails", f"local maximum up to {LOW_SPEED:g} m/s, least behind it", "highest", f"at {PUBLISHED_AT:g} m/s", "against upright",
               "at 200 m/s"], 2,
              {"figure6-speed.svg": "flat-by-speed.svg", "figure6-histories.svg": "flat-low-speed.svg"}),
    7: Figure("simulate", "patches.csv", by_angle, ["pitch [°]", "middle of the patch, ahead of the axle [mm]", "from the middle of the track [mm]",
                                                    "largest pressure [MPa]"], 1,
              {"patches.svg": "flat-patches.svg"}),
}


def block(number):
    """Where a table stands on the page: between two comments."""
    return re.compile(rf"(<!-- figure {number} -->\n).*?(<!-- end of figure {number} -->)", re.DOTALL)


def table(figure, rows):
    lines = ["| " + " | ".join(figure.head) + " |", "|---" * len(figure.head) + "|"]
    lines += ["| " + " | ".join([*keys, *cells]) + " |" for keys, cells in rows.items()]
    return "\n".join(lines) + "\n"


def solve(program, number, folder):
    figure = FIGURES[number]
    out = folder / f"figure{number}"
    run = subprocess.run([program, figure.verb, ROOT / f"examples/figure{number}.toml", "-o", out, "--quiet"], stdout=subprocess.DEVNULL,
                         stderr=subprocess.PIPE, text=True)
    if run.returncode:
        sys.exit(f"figure {number}: status {run.returncode}\n{run.stderr}")
    return out


def self_test():
    speeds = "kind,line,run,simulation.speed_m_s,q_max_N\n" + "".join(
        f'run,"cant = {cant}, track = fitted",1,{v},{q}\n' for cant, more in (("none", 1.0), ("1:40", 1.15))
        for v, q in ((4, 100e3 * more), (6, 130e3 * more), (10, 120e3 * more), (60, 200e3 * more), (200, 150e3 * more)))
    assert by_speed(speeds + "reference,published,,60,462000\n") == {
        ("fitted", "upright"): ["130 at 6, 120 at 10", "200 at 60", "200", "", "150"],
        ("fitted", "1:40"): ["150 at 6, 138 at 10", "230 at 60", "230", "+15 %", "172"]}, by_speed(speeds)
    rising = "kind,line,run,simulation.speed_m_s,q_max_N\n" + "".join(f'run,"cant = none, track = lumped",1,{v},{v}e3\n' for v in (4, 6, 10, 60))
    assert by_speed(rising)["lumped", "upright"][0] == "none"
    assert by_theory('run,panel,t_s,Q_N,Ty_N\n"FASTSIM, 0.5 mm",,0.01,50e3,-1e3\n"FASTSIM, 0.5 mm",,0.0125,400e3,-39.6e3\n'
                     '"FASTSIM, 0.5 mm",,0.013,0,11e3\n') == {("FASTSIM", "0.5 mm"): ["400.0 at 12.50", "-39.6 at 12.50", "11.0"]}
    cell = "panel,pitch_rad,kind,x_m,y_m,value\n"
    assert by_angle(cell + "1,0.0872664626,pressure_Pa,-0.002,0.739,5e8\n1,0.0872664626,pressure_Pa,-0.001,0.741,9e8\n"
                    "2,-0.174532925,defect_depth_m,0,0.74,0.001\n") == {("5.0",): ["-1.5", "740.0", "900"], ("-10.0",): ["none"] * 3}
    for number, figure in FIGURES.items():
        found = block(number).search(PAGE.read_text())
        assert found, f"{PAGE.name} has no place for the table of figure {number}"
        assert table(figure, {}).splitlines()[0] in found[0], f"{PAGE.name}: another head of the table of figure {number}"
        for picture in figure.pictures.values():
            assert (ROOT / "docs" / picture).exists(), picture
    print("tables of figures are read and have their places")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=ROOT / "build/release/app/treadmark", type=pathlib.Path)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--only", nargs="*", type=int, choices=FIGURES, default=list(FIGURES))
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--self-test", action="store_true")
    options = parser.parse_args()
    if options.self_test:
        return self_test()
    with tempfile.TemporaryDirectory() as temporary:
        for number in options.only:
            figure = FIGURES[number]
            out = solve(options.program.resolve(), number, options.out or pathlib.Path(temporary))
            made = table(figure, figure.rows((out / figure.table).read_text()))
            print(f"figure {number}\n{made}")
            if not options.write:
                continue
            PAGE.write_text(block(number).sub(lambda found: found[1] + made + found[2], PAGE.read_text()))
            for name, picture in figure.pictures.items():
                shutil.copyfile(out / name, ROOT / "docs" / picture)
    return 0


if __name__ == "__main__":
    sys.exit(main())
