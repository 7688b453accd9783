#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""The page of examples with their numbers, docs/gallery.md, and its pictures in docs/gallery.

  scripts/gallery.py [PROGRAM]            solves all and writes page and pictures
  scripts/gallery.py --check [PROGRAM]    solves all and compares the numbers with those of the page; exit status 1 where one differs

PROGRAM: default build/release/app/treadmark. An entry of ENTRIES is a section; what stands above the first one is written by hand.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/gallery.md"
MARK = "<!-- what follows is written by scripts/gallery.py -->\n"


@dataclass
class Entry:
    example: str
    title: str
    words: str
    columns: list
    cases: list = field(default_factory=list)  # numbers; empty: all
    plot: list = field(default_factory=list)  # --what and more; empty: none
    verb: str = "run"
    rows: str = ""  # of a table that is no result of cases: the file, and which rows


def patch(key, factor=1.0):
    return lambda case: max(factor * p[key] for p in case["patches"])


def of(group, key, factor=1.0):
    return lambda case: factor * case[group][key]


PMAX = ("largest pressure [MPa]", patch("pmax_MPa"))
VERTICAL = ("F_z [kN]", of("force_on_rail", "fz_tr_N", 1e-3))
LENGTHWISE = ("F_x [kN]", of("force_on_rail", "fx_tr_N", 1e-3))
LATERAL = ("F_y [kN]", of("force_on_rail", "fy_tr_N", 1e-3))
HEIGHT = ("height of the wheelset [mm]", of("wheelset", "z_mm"))
PATCHES = ("patches", lambda case: len(case["patches"]))
SLIP = ("share in slip", patch("slip_share"))
XI = ("creepage ξ", patch("xi"))

ENTRIES = [
    Entry("wheel-flat", "A wheel with a flat", "Thirteen positions of a wheel as a rounded flat of 160 mm passes. "
          "[Defects](defects.md).", [HEIGHT, PMAX, PATCHES], [1, 4, 7, 10, 13], ["--what", "pressure", "--case", "3,5,7,9"]),
    Entry("rolling-flat", "Rolling over a flat, in time", "Transient rolling: tractions of every step start from those of the step before.",
          [PMAX, LENGTHWISE, SLIP], [1, 100, 200, 300, 400], ["--what", "traction", "--case", "1,200,400"]),
    Entry("squat", "A squat", "A wheel passes the two dips of a squat. [Defects](defects.md).", [HEIGHT, PMAX, PATCHES], [],
          ["--what", "pressure", "--case", "1,3,5"]),
    Entry("corrugation", "Short-pitch corrugation", "", [HEIGHT, PMAX, PATCHES], [], ["--what", "pressure"]),
    Entry("milled-rail", "A rail as a milling cutter leaves it", "", [HEIGHT, PMAX, PATCHES], [], ["--what", "pressure"]),
    Entry("crossing-passage", "Over a crossing", "From the wing rail to the nose. [Crossings](crossings.md).", [HEIGHT, PMAX, PATCHES],
          [40, 75, 85, 95, 110, 150], ["--what", "pressure", "--case", "75,85,95,110"]),
    Entry("flange-root", "Conformal contact in the flange root", "On a tangent plane, on a reference that curves with the surfaces, and there with "
          "influence coefficients that know the inclination.", [PMAX, LATERAL, ("contact angle [°]", lambda c: math.degrees(
              c["patches"][0]["reference"]["angle_rad"]))], [], ["--what", "pressure"]),
    Entry("braked-wheel", "Temperatures of a braked wheel", "Flash temperatures of steady rolling, and friction that falls with them.",
          [XI, LENGTHWISE, ("rail [°C]", patch("max_temperature_1_C")), ("wheel [°C]", patch("max_temperature_2_C"))], [],
          ["--what", "temperature_1"]),
    Entry("creep-curves", "Creep curves, a layer, falling friction", "Forces over creepage of a clean surface, with an elastic layer between "
          "wheel and rail, and with friction that falls with the velocity of slip.",
          [("creepage", "patch.creepage_x"), ("surface", "surface"), ("F_x [kN]", "Tx_max_N", 1e-3)], [0.001, 0.005, 0.02],
          ["--what", "picture-creep-curves-svg"], "sweep", "sweep.csv"),
    Entry("stresses-below", "Stresses below the surface", "Without tangential forces, and below a wheel that drives.", [PMAX, LENGTHWISE], [],
          ["--what", "von-mises-along-rail", "--case", "2"]),
    Entry("onset-of-rolling", "From a shift to rolling", "Cattaneo's shift of a ball, then rolling under the same force (Kalker 1990).",
          [("F_x [N]", patch("fx_N")), SLIP], [1, 2, 10, 30, 57], ["--what", "traction_x", "--case", "1,10,57"]),
    Entry("hollow-wheel", "A wheel worn hollow", "[Evolution](evolve.md).", [("distance [km]", "distance_km"), ("worn, deepest [mm]", "wheel_depth_mm"), ("hollow [mm]", "wheel_hollow_mm"),
                                                               ("largest pressure [MPa]", "pmax_MPa"), ("conicity", "wheel_conicity_3mm")],
          [], ["--what", "wheel-section"], "evolve", "evolution.csv"),
    Entry("curve", "A vehicle in a curve", "Canted, on irregular track. [Vehicles](vehicle-simulation.md).",
          [("instant [s]", "t_s"), ("Q of the first left wheel [kN]", "Q_N", 1e-3), ("Y [kN]", "Y_N", 1e-3)], [], ["--what", "forces"],
          "simulate", "history.csv"),
]


def digits(value):
    if isinstance(value, str):
        return value
    return "0" if abs(value) < 1e-12 else f"{value:.4g}"


def rows_of(entry, folder):
    """The lines of numbers of a solved example."""
    if not entry.rows:
        cases = json.loads((folder / "result.json").read_text())["cases"]
        chosen = [c for c in cases if not entry.cases or c["case"] in entry.cases]
        return ["case"] + [name for name, _ in entry.columns], [[str(c["case"])] + [digits(of_case(c)) for _, of_case in entry.columns] for c in chosen]
    with open(folder / entry.rows, newline="") as file:
        lines = list(csv.DictReader(file))
    if entry.cases:
        lines = [line for line in lines if float(line[entry.columns[0][1]]) in entry.cases]
    else:  # five of all, the first and the last among them
        lines = [lines[round(k * (len(lines) - 1) / 4)] for k in range(5)]

    def cell(line, name, factor=None):
        return digits(float(line[name]) * (factor or 1.0)) if re.fullmatch(r"[-+.\deE]+", line[name]) else line[name]
    return [column[0] for column in entry.columns], [[cell(line, *column[1:]) for column in entry.columns] for line in lines]


def section(entry, program, work, pictures):
    folder = work / entry.example
    environment = {**os.environ, "TREADMARK_CACHE": "off"}

    def call(*words):
        done = subprocess.run([str(program), *words], cwd=ROOT, env=environment, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"treadmark {' '.join(words)} failed: {done.stderr}")
    call("--quiet", entry.verb, f"examples/{entry.example}.toml", "-o", str(folder))
    head, lines = rows_of(entry, folder)
    text = f"## {entry.title}\n\n"
    if entry.words:
        text += entry.words + "\n\n"
    command = f"treadmark {entry.verb} examples/{entry.example}.toml -o out/{entry.example}"
    if entry.plot:
        command += f"\ntreadmark plot out/{entry.example} {' '.join(entry.plot)} -o {entry.example}.svg"
    text += f"```\n{command}\n```\n\n| {' | '.join(head)} |\n|{'--:|' * len(head)}\n"
    text += "".join(f"| {' | '.join(line)} |\n" for line in lines)
    if entry.plot:
        if pictures:
            call("plot", str(folder), *entry.plot, "-o", str(pictures / f"{entry.example}.svg"))
        text += f"\n![{entry.title}](gallery/{entry.example}.svg)\n"
    return text


def thumbnails():
    """Pictures that lead to their sections."""
    def anchor(title):
        return re.sub(r"[^a-z0-9 -]", "", title.lower()).replace(" ", "-")
    across = 4
    cells = [f'[<img src="gallery/{e.example}.svg" alt="{e.title}" width="160"><br>{e.title}](#{anchor(e.title)})' for e in ENTRIES if e.plot]
    rows = ["| " + " | ".join(cells[k:k + across]) + " |" for k in range(0, len(cells), across)]
    return "\n" + "\n".join([rows[0], "|" + across * ":-:|", *rows[1:]]) + "\n"


def differences(old, new):
    """Lines whose numbers differ by more than rounding, or whose words differ."""
    number = re.compile(r"-?\d+\.?\d*(?:e[-+]?\d+)?")
    out = []
    for a, b in zip(old.splitlines(), new.splitlines()):
        x, y = ([float(n) for n in number.findall(line)] for line in (a, b))
        same = len(x) == len(y) and all(abs(p - q) <= 2e-3 * max(abs(p), abs(q)) + 1e-9 for p, q in zip(x, y))
        if number.sub("", a) != number.sub("", b) or not same:
            out.append(f"- {a}\n+ {b}")
    if len(old.splitlines()) != len(new.splitlines()):
        out.append(f"{len(old.splitlines())} lines in the page, {len(new.splitlines())} now")
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", type=pathlib.Path, default=ROOT / "build/release/app/treadmark")
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    by_hand, _, before = PAGE.read_text().partition(MARK)
    pictures = None if options.check else ROOT / "docs/gallery"
    if pictures:
        pictures.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as work:
        text = thumbnails() + "\n" + "\n".join(section(entry, options.program.resolve(), pathlib.Path(work), pictures) for entry in ENTRIES)
    if not options.check:
        PAGE.write_text(by_hand + MARK + text)
        return 0
    wrong = differences(before, text)
    print("\n".join(wrong) if wrong else f"{len(ENTRIES)} examples give the numbers of {PAGE.name}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
