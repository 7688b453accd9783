#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Runs the commands in blocks of code of the documents, page by page in a folder of its own, over small files of the names that the pages use.

usage: run_documents.py ROOT PROGRAM [PAGE ...]
Long commands are shortened as SHORTER says; ONLY_TAKEN names those that commands_test.py validates and nobody runs, and why.
"""
import math
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile

from documented_commands import commands_of, pages_of

ONLY_TAKEN = {
    r".*--plugin": "needs a plug-in: tests/app/plugins builds one",
    r"^sweep examples/figure6": "240 runs, as the figure needs; a study runs on the page of studies",
    r"^sweep .*(--slurm|--status|/shared/)": "needs a cluster: tests of Slurm run these",
    r"^sweep .*--runs 1-400": "a sample of a study of 100 000 runs",
    r"^stability .*--falling": "a run of several kilometres: tests of stability shorten it through the library",
    r"^assess .*--section": "places of a run of hundreds of metres: tests of assessments do it",
    r"^run my\.toml.*": "the case of README.md, which has a test of its own",
    r"^check my\.toml": "the same",
    r"^design": "a search of minutes: tests of designs shorten it",
    r"^live": "needs the program for browsers: scripts/web.sh runs it",
}

OTHER_TESTS = {"gallery.md": "Docs.GalleryHasTheNumbersOfTheExamples"}

# What is put behind or in place of parts of a command, so that it takes about a second.
SHORTER = [
    (r"^simulate (examples/(flat|cross|curve)|ride)", ["--set", "simulation.distance_m=0.02"]),
    (r"^simulate examples/(wagon|train)", ["--set", "simulation.distance_m=1"]),
    (r"^simulate examples/twist", ["--set", "simulation.distance_m=0.5", "--set", "simulation.twist.period_s=1"]),
    (r"^compare(?!.*--detectors)", ["--backends", "spline,mesh-flat", "--resolutions", "1"]),
    (r"^scan (?!.*--points)", ["--points", "60000"]),
    (r"^bench(?!.*--resolutions)", ["--resolutions", "1"]),
    (r"^bench(?!.*--backends)", ["--backends", "spline,mesh"]),
    (r"^bench", ["--seconds-per-measure", "0.001"]),
    (r"^stability", ["--count", "4"]),
    (r"^measure rail measured.ban", ["--alignment", "top"]),  # the head alone has too little that does not wear
    (r"^table case", ["--lateral-range-mm", "1", "--step-mm", "1", "--element-mm", "2", "--roll-intervals", "0", "--yaw-intervals", "0",
                      "--creep-forces", "linear", "--check-points", "2"]),
    (r"^evolve", ["--set", "evolve.distance_km=2000"]),
]
REPLACED = {"2000000": "40000", "1,0.25": "1"}

CASE = """wheel.shape.standard = "S1002"
rail.shape.standard = "60E1"
track.cant = "1:40"
discretisation.dx_mm = 1
discretisation.ds_mm = 1
[wheelset]
nominal_radius_mm = 460
vertical_force_N = 100e3
velocity_km_h = 100
rolling = "nominal"
[[cases]]
wheelset.y_mm = [0, 2]
"""

STUDY = """[study]
title = "Loads"
base = "case.toml"
[[study.vary]]
key = "wheelset.vertical_force_N"
values = [50e3, 55e3, 60e3, 65e3, 70e3, 75e3, 80e3, 85e3, 90e3, 95e3]
"""


class Inputs:
    """Files of the names that pages use, small and real."""

    def __init__(self, folder, root, program):
        self.folder, self.program = folder, program
        shutil.copytree(root / "examples", folder / "examples")
        self.edit("examples/wheel-flat.toml", r"wheelset\.pitch_deg = \[.*\]", "wheelset.pitch_deg = [0, 2]")
        self.edit("examples/wheel-flat.toml", r"d([xs])_mm = 0\.5", r"d\1_mm = 1")
        self.edit("examples/flat-at-speed.toml", r"d([xs])_mm = 0\.5", r"d\1_mm = 1")
        self.edit("examples/flat-at-speed.toml", 'regime = "transient"', 'regime = "steady"')
        shutil.copy(folder / "examples/wheel-flat.toml", folder / "wheel-flat.toml")
        for name in ("case.toml", "my-case.toml", "CASE.toml"):
            (folder / name).write_text(CASE)
        (folder / "study.toml").write_text(STUDY)
        (folder / "list.toml").write_text('cases_file = "places.csv"\n' + CASE.partition("[[cases]]")[0])
        (folder / "places.csv").write_text("wheelset.y_mm,wheelset.yaw_deg\n0,0.1\n0.5,0.1\n")
        shutil.copytree(folder / "examples/vehicles", folder / "vehicles")
        shutil.copytree(folder / "examples/tracks", folder / "tracks")
        shutil.copy(folder / "examples/flat-at-speed.toml", folder / "SIMULATION.toml")
        for body, names in (("wheel", "measured.whl right.whl left.whl worn.prw wheel.prw"), ("rail", "measured.ban right.ban left.ban")):
            for name in names.split():
                self.treadmark("convert", "case.toml", name, "--body", body)
        (folder / "fleet").mkdir()
        shutil.copy(folder / "measured.whl", folder / "fleet/one.whl")
        (folder / "more.txt").write_text("measured.whl\n")
        (folder / "limits.toml").write_text("[wheel]\nflange_height_mm = { max = 36 }\n")
        (folder / "fleet.csv").write_text("name,wheel,rail\na,worn.prw,60E1\nb,S1002,right.ban\n")
        across = range(-25, 26)
        grid = [f"{x}," + ",".join(f"{0.02 * math.sin(x / 40):.5f}" for _ in across) for x in range(0, 400, 4)]
        (folder / "deviations.csv").write_text("," + ",".join(map(str, across)) + "\n" + "\n".join(grid) + "\n")
        for name, body, options in (
            ("wheel.ply", "wheel", ()),
            ("scan.las", "wheel", ()),
            ("pass1.las", "rail", ("--range-mm", "-60,20")),
            ("pass2.las", "rail", ("--range-mm", "-20,60")),
        ):
            self.treadmark("scan", "wheel-flat.toml", "-o", name, "--body", body, "--points", "30000", *options)
        self.treadmark("scan", "wheel-flat.toml", "-o", "one.xyz", "--body", "rail", "--points", "25000", "--range-mm=-600,600")
        rail = [[float(word) for word in line.split()] for line in (folder / "one.xyz").read_text().splitlines()[1:]]
        both = [f"{x} {beside - y} {-z}\n" for beside in (0, 1505) for x, y, z in rail]  # z is up
        (folder / "track.xyz").write_text("# x[mm] y[mm] z[mm]\n" + "".join(both))
        self.treadmark("convert", "case.toml", "scan.slcs", "--body", "rail", "--range-mm=-300,300", "--resolution", "2")
        for run in ("run", "a", "b", "c"):
            self.treadmark("simulate", "examples/flat-at-speed.toml", "-o", f"out/{run}", "--set", "simulation.distance_m=0.05")

    def edit(self, name, pattern, replacement):
        text, count = re.subn(pattern, replacement, (self.folder / name).read_text())
        assert count, f"{name} has no {pattern}"
        (self.folder / name).write_text(text)

    def treadmark(self, *words):
        done = subprocess.run([self.program, "--quiet", *words], cwd=self.folder, capture_output=True, text=True)
        assert done.returncode == 0, f"treadmark {' '.join(words)}: {done.stderr}"


def shortened(words):
    command = " ".join(words[1:])
    words = [REPLACED.get(word, word) for word in words]
    for pattern, more in SHORTER:
        if re.search(pattern, command):
            words += [one for one in more] if more[0] == "--set" or more[0] not in words else []
    return words


def used():
    now = resource.getrusage(resource.RUSAGE_CHILDREN)
    return now.ru_utime + now.ru_stime


root, program = map(pathlib.Path, sys.argv[1:3])
environment = {**os.environ, "PATH": f"{program.parent}:{os.environ['PATH']}"}
wrong, count, taken = [], 0, set()
with tempfile.TemporaryDirectory() as name:
    inputs = pathlib.Path(name) / "inputs"
    inputs.mkdir()
    Inputs(inputs, root, program)
    print(f"inputs: {used():.1f} s", flush=True)
    for page in pages_of(root):
        if page.name in OTHER_TESTS or (len(sys.argv) > 3 and page.name not in sys.argv[3:]):
            continue
        commands = [(line, words) for line, words, block in commands_of(page.read_text(encoding="utf-8")) if block]
        folder = pathlib.Path(name) / page.stem
        for line, words in commands:
            reasons = [pattern for pattern in ONLY_TAKEN if re.search(pattern, " ".join(words[1:]))]
            taken.update(reasons)
            if reasons:
                continue
            if not folder.exists():
                shutil.copytree(inputs, folder)
            before = used()
            done = subprocess.run(shortened(words), cwd=folder, env=environment, capture_output=True, text=True)
            count += 1
            print(f"{used() - before:5.1f} s  {page.relative_to(root)}:{line}: {' '.join(shortened(words))}", flush=True)
            if done.returncode != 0:
                wrong.append(f"{page.relative_to(root)}:{line}: {' '.join(shortened(words))} ends with {done.returncode}\n{done.stderr[-600:]}")
print("\n".join(wrong) or f"{count} commands in {used():.0f} s of processor time")
if len(sys.argv) == 3:
    assert count > 50, count
    assert taken == set(ONLY_TAKEN), f"nothing is left of {set(ONLY_TAKEN) - taken}"
sys.exit(1 if wrong else 0)
