#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Wear number of a wheel that touches with tread and flange root at a time, from a table of forces and solved in full: a line of
docs/vehicle-simulation.md.

usage: two-contacts.py [--write]     with PYTHONPATH=<build folder>/interfaces/python

--write puts both numbers into the page.
"""
import argparse
import pathlib
import re
import sys

import treadmark

PAGE = pathlib.Path(__file__).resolve().parent.parent / "docs/vehicle-simulation.md"
LINE = re.compile(r"(makes )\d+( N of wear number by the exact theory, against )\d+( N of the full contact)")
Y, SPEED, RADIUS, LOAD = 5e-3, 20.0, 0.46, 54.5e3


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true")
    write = parser.parse_args().write
    given = treadmark.Problem(nominal_radius=RADIUS, y=Y, speed=SPEED, pitch_rate=-SPEED / RADIUS, vertical_force=LOAD, friction=0.3,
                              dx=0.4e-3, ds=0.4e-3, set={"track.cant": "1:40"})
    pair = treadmark.Pair(treadmark.Surface.standard("60E1"), treadmark.Surface.standard("S1002", nominal_radius=RADIUS), given)
    full = pair.solve(set={"contact.reference_surface": "plane_surface_slip"})
    table = treadmark.ForceTable.of_pair(pair, set={"lateral_range_mm": 7, "step_mm": 0.25, "element_mm": 0.4, "roll_intervals": 0,
                                                    "yaw_intervals": 0, "check_points": 1})
    forces = table.forces(y=Y, vx=SPEED, vpitch=-SPEED / RADIUS, vertical_load=LOAD)
    numbers = [f"{number:.0f}" for number in (float(forces["t_gamma"]), sum(patch.t_gamma for patch in full.patches))]
    print(f"from a table {numbers[0]} N, in full {numbers[1]} N")
    text = PAGE.read_text()
    if not LINE.search(text):
        sys.exit(f"{PAGE.name} has no such line")
    if write:
        PAGE.write_text(LINE.sub(rf"\g<1>{numbers[0]}\g<2>{numbers[1]}\g<3>", text))
    return 0


if __name__ == "__main__":
    sys.exit(main())
