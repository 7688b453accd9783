#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Whether a change leaves every output as it was: runs every verb over the examples, and `run` over the inputs in a shared folder where there is one,
with a program, and compares all files and texts with those of another program. Texts and pages are compared byte for byte, HDF5 files by their values
(needs Debian's python3-h5py), FMUs by what they hold beside libraries; times, the revision and the program's own path are masked.

usage: compare-outputs.py run PROGRAM FOLDER [--only PATTERN] [--jobs N]    keeps the outputs of a program
       compare-outputs.py diff BEFORE AFTER                                what differs; exit status 1 when something does
       compare-outputs.py self-test                                        every verb is run, and every difference is seen

The inputs of the reference program are looked for in $TREADMARK_SHARED or ../shared.
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

import h5py

ROOT = pathlib.Path(__file__).resolve().parent.parent
SHARED = pathlib.Path(os.environ.get("TREADMARK_SHARED", ROOT.parent / "shared"))
EXAMPLES = ROOT / "examples"
TIME_NAMES = r"(?:seconds|(?:build|distance|normal|search|tangential|total|cold|warm)_s)"
MASKS = [
    (rb'("' + TIME_NAMES.encode() + rb'": ?)[-+.e0-9]+', rb"\1#"),
    (rb"^(case [^\n]*, )[0-9.]+ s$", rb"\1# s"),
    (rb"^time: [^\n]*$", b"time: #"),
    (rb'(Wall-clock time</span><span class="card-value">)[^<]*', rb"\1#"),
    (rb"built in [-+.e0-9]+ s", b"built in # s"),
]
MEASURED_TIMES = ("bench-",)  # jobs whose numbers are times: their files are only counted


def verbs():
    return re.findall(r"^VERB\((\w+),", (ROOT / "app/cli/verbs.def").read_text(), re.MULTILINE)


def jobs():
    """Name and commands of each job; OUT stands for its folder."""
    results = ["-o", "OUT/results", "--json", "OUT/result.json", "--report", "OUT/report.html"]

    def example(name):
        return str(EXAMPLES / f"{name}.toml")

    yield "help", [["--help"]]
    for verb in verbs():
        yield f"help-{verb}", [[verb, "--help"]]
    yield "schema", [["schema"]]
    yield "man", [["man"]]
    for shell in ("bash", "zsh", "fish"):
        yield f"completion-{shell}", [["completion", shell]]
    for topic in "backends defects laws profiles solvers verbs nonsense".split():
        yield f"list-{topic}", [["list", topic]]
    for kind in "case study vehicle track simulation import backend".split():
        yield f"new-{kind}", [["new", kind, f"OUT/{kind}.{'py' if kind == 'backend' else 'toml'}"]]

    yield "live", [["live", "--no-open", "-o", "OUT/live.html"]]  # an error where there is no program for browsers

    for case in sorted(EXAMPLES.glob("*.toml")):
        text = case.read_text()
        yield f"check-{case.stem}", [["check", str(case)]]
        if not re.search(r"^\[(evolve|study|simulation|design)", text, re.MULTILINE):
            yield f"run-{case.stem}", [["run", str(case), *results], ["plot", "OUT/results", "--what", "pressure", "-o", "OUT/plot.svg"], ["report", "OUT/results", "-o", "OUT/again.html"]]
            # what .inp cannot say is refused: so is its message compared
            yield f"convert-{case.stem}", [["convert", str(case), "-o", "OUT/case.inp"], ["convert", str(case), "-o", "OUT/case.toml"]]
    yield "compare-squat", [["compare", example("squat"), "-o", "OUT/results", "--report", "OUT/report.html"]]
    yield "diff-flat", [["run", example("wheel-flat"), "-o", "OUT/a"], ["run", example("wheel-flat"), "-o", "OUT/b", "--set", "friction.coefficient=0.2"], ["diff", "OUT/a", "OUT/b"], ["report", "OUT/a", "OUT/b", "-o", "OUT/overlay.html"]]
    yield "bench-flat", [["bench", example("wheel-flat"), "--resolutions", "1", "--seconds-per-measure", "0.01", "-o", "OUT/results", "--report", "OUT/report.html"]]
    small = ["--lateral-range-mm", "1", "--step-mm", "1", "--element-mm", "2", "--roll-intervals", "0", "--yaw-intervals", "0", "--creep-forces", "linear", "--check-points", "4"]
    yield "table-braked", [["table", example("braked-wheel"), *small, "-o", f"OUT/table.{end}"] for end in ("h5", "json", "csv")]
    yield "conform-flat", [["conform", example("wheel-flat")], ["conform", "spline"]]
    yield "trace-flat", [["trace", example("wheel-flat"), "--body", "wheel", "--line-mm", "0", "--range-deg", "-10", "10"]]

    pair = ["geometry", "--wheel", "S1002", "--rail", "60E1", "--cant", "1:40", "--gauge-mm", "1435"]
    yield "geometry-new", [[*pair, "-o", "OUT/results", "--json", "OUT/result.json", "--csv", "OUT/table.csv", "--report", "OUT/report.html"], pair]
    yield "geometry-gauges", [[*pair, "--gauges-mm", "1430:1440:2", "--axle-load-kN", "180", "--yaw-mrad", "2", "--roll", "free", "--new-wheel", "S1002", "-o", "OUT/results"]]
    for name, body, part in (("crossing", "rail", "mm"), ("squat", "rail", "mm"), ("wheel-flat", "wheel", "deg")):
        ends = (".ply", ".vdb", ".slcw" if body == "wheel" else ".slcs")
        yield f"convert-shape-{name}", [["convert", example(name), "--body", body, f"--range-{part}", "-5", "5", "--resolution", "1", "-o", f"OUT/shape{end}"] for end in ends]
    scan = ["scan", example("wheel-flat"), "--body", "wheel", "--points", "60000", "-o", "OUT/scan.ply", "--truth", "OUT/truth.json", "--noise-mm", "0.03", "--seed", "3"]
    yield "scan-flat", [[*scan, "--frame", "random"]]
    yield "import-flat", [scan, ["import", "OUT/scan.ply", "--body", "wheel", "--resolution", "2", "--truth", "OUT/truth.json", "-o", "OUT/wheel.slcw", "-o", "OUT/wheel.ply", "--report", "OUT/audit", "--json", "OUT/audit.json"],
                          ["measure", "wheel", "OUT/wheel.slcw", "--json", "OUT/measured.json", "--csv", "OUT/measured.csv", "--hdf5", "OUT/measured.h5", "--report", "OUT/report.html"],
                          ["plot", "OUT/audit"], ["report", "OUT/audit", "-o", "OUT/audit.html"]]
    yield "measure-standards", [["measure", body, name, *said] for body, name in (("wheel", "S1002"), ("rail", "60E1")) for said in ([], ["--json", f"OUT/{body}.json", "--csv", f"OUT/{body}.csv"])]
    yield "measure-shapes", [["measure", "wheel", example("wheel-flat"), "--json", "OUT/wheel.json", "--csv", "OUT/wheel.csv", "--report", "OUT/wheel.html"],
                             ["measure", "rail", example("corrugation"), "--json", "OUT/rail.json", "--report", "OUT/rail.html"], ["measure", "rail", example("corrugation")]]

    for case, distance in (("crossing-vehicle", 1.0), ("curve", 2.0), ("flat-at-speed", 0.6), ("wagon-push", 10.0)):
        yield f"simulate-{case}", [["simulate", example(case), "--set", f"simulation.distance_m={distance}", "-o", "OUT/results", "--report", "OUT/report.html"], ["plot", "OUT/results", "--what", "wheels", "-o", "OUT/plot.svg"],
                                   ["assess", "OUT/results", "-o", "OUT/assessed", "--json", "OUT/assessed.json", "--csv", "OUT/assessed.csv", "--report", "OUT/assessed.html"], ["assess", "OUT/results"]]
    straight = ["--set", "simulation.wheels=[]"]
    yield "stability-flat", [["stability", example("flat-at-speed"), *straight, "--from", "20", "--to", "60", *said] for said in ([], ["-o", "OUT/results", "--json", "OUT/result.json"])]
    yield "response-flat", [["response", example("flat-at-speed"), *straight, "--count", "5", *said] for said in ([], ["-o", "OUT/results", "--json", "OUT/result.json"])]
    yield "track-fit", [["track", str(EXAMPLES / "tracks/zhai-flexible.toml"), "--fit", "1", *said] for said in ([], ["-o", "OUT/results", "--json", "OUT/result.json"])]
    yield "fmu-flat", [["fmu", example("wheel-flat"), "-o", "OUT/wheel.fmu"]]
    yield "sweep-creep", [["sweep", example("creep-curves"), "--runs", "1-3", "-o", "OUT/results"], ["sweep", example("creep-curves"), "-o", "OUT/results", "--status"],
                          ["sweep", example("creep-curves"), "-o", "OUT/all", "--report", "OUT/report.html"]]

    def evolve(case, *changes):
        sets = [word for change in changes for word in ("--set", change)]
        return [["evolve", example(case), *sets, "-o", "OUT/results", "--vtk", "--json", "OUT/result.json", "--report", "OUT/report.html"],
                ["evolve", example(case), *sets, "-o", "OUT/results", "--resume"], ["report", "OUT/results", "-o", "OUT/again.html"]]

    yield "evolve-hollow", evolve("hollow-wheel", "evolve.distance_km=4000")
    yield "evolve-tired", evolve("tired-rail", "evolve.passages=2e4", "heat.compute=true", "evolve.rail.fatigue.austenite_C=40",
                                 'evolve.rail.fatigue.measures=["fi_surf", "shakedown", "whole_life", "subsurface", "dang_van", "martensite"]')
    yield "evolve-flowing", evolve("flowing-flat", "evolve.distance_km=0.01")
    yield "design-rail", [["design", example("ground-rail"), "--set", "design.solutions=12", "-o", "OUT/results", "--json", "OUT/result.json", "--report", "OUT/report.html"],
                          ["report", "OUT/results", "-o", "OUT/again.html"]]
    for folder in ("contact_examples", "contact_testbank"):
        for case in sorted((SHARED / "data" / folder).glob("**/*.inp")):
            yield f"inp-{case.stem}", [["run", str(case), *results]]


def run(program, name, commands, folder):
    out = folder / name
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    texts, statuses = {"stdout": b"", "stderr": b""}, []
    for arguments in commands:
        done = subprocess.run([program, "--threads", "1", "--quiet", *(a.replace("OUT", ".", 1) if a.startswith("OUT") else a for a in arguments)],
                              cwd=out, capture_output=True)
        statuses.append(done.returncode)
        for stream in texts:
            texts[stream] += getattr(done, stream).replace(program.encode(), b"PROGRAM")
    for stream, text in texts.items():
        (out / stream).write_bytes(text)
    (out / "status").write_text("\n".join(map(str, statuses)) + "\n")
    return name, statuses


def masked(data, revision):
    if revision:
        data = data.replace(revision, b"0000000")
    times = set(re.findall(rb'"' + TIME_NAMES.encode() + rb'": ?([-+.e0-9]+)', data)) - {b"0", b"0.0"}
    if times:  # of a page, whose tables repeat them
        data = re.sub(rb'data-value="([-+.e0-9]+)">[^<]*', lambda cell: b"#" if cell[1] in times else cell[0], data)
    for pattern, text in MASKS:
        data = re.sub(pattern, text, data, flags=re.MULTILINE)
    return data


def hdf5_values(path, revision):
    """What is in a file, by its place there."""
    values = {}

    def keep(place, value):
        name = place.rsplit("/", 1)[-1].rsplit("@", 1)[-1]
        if re.fullmatch(TIME_NAMES, name):
            return
        raw = value.tobytes() if hasattr(value, "tobytes") and getattr(value, "dtype", object) != object else str(value if not hasattr(value, "tolist") else value.tolist()).encode()
        values[place] = masked(raw, revision), str(getattr(value, "dtype", type(value))), getattr(value, "shape", ())

    def visit(name, item):
        for key, value in item.attrs.items():
            keep(f"{name}@{key}", value)
        if isinstance(item, h5py.Dataset):
            keep(name, item[()])

    with h5py.File(path) as file:
        visit("", file)
        file.visititems(visit)
    return values


def members(path, revision):
    """What is in an archive, by its name there, but the libraries of an FMU."""
    with zipfile.ZipFile(path) as archive:
        return {name: masked(archive.read(name), revision) for name in archive.namelist() if not name.startswith("binaries/")}


BY_PLACE = {".h5": hdf5_values, ".fmu": members}


def differences(before, after):
    revisions = [(folder / "revision").read_bytes().strip() for folder in (before, after)]
    names = sorted({p.relative_to(f) for f in (before, after) for p in f.rglob("*") if p.is_file()} - {pathlib.Path("revision")})
    for name in names:
        old, new = before / name, after / name
        if not old.exists() or not new.exists():
            yield f"{name}: only {'before' if old.exists() else 'after'}"
        elif name.parts[0].startswith(MEASURED_TIMES):
            continue
        elif values := BY_PLACE.get(name.suffix):
            a, b = (values(path, revision) for path, revision in zip((old, new), revisions))
            places = [place for place in sorted(a.keys() | b.keys()) if a.get(place) != b.get(place)]
            if places:
                yield f"{name}: {len(places)} of {len(b)} values differ, first {places[0]}"
        elif masked(old.read_bytes(), revisions[0]) != masked(new.read_bytes(), revisions[1]):
            yield f"{name}: differs"


def self_test():
    run_of = {command[0] for _, commands in jobs() for command in commands if "--help" not in command}
    missing = [verb for verb in verbs() if verb not in run_of]
    assert not missing, f"no job runs {', '.join(missing)}"
    with tempfile.TemporaryDirectory() as folder:
        sides = [pathlib.Path(folder) / side for side in ("before", "after")]

        def write(side, revision, seconds, number):
            job = side / "job"
            job.mkdir(parents=True, exist_ok=True)
            (side / "revision").write_text(revision)
            (job / "r.json").write_text(f'{{"git": "{revision}", "seconds": {seconds}, "pmax": {number}}}')
            (job / "p.html").write_text(f'<td data-value="{seconds}">{seconds}</td><td data-value="{number}">1</td><script>{{"seconds":{seconds}}}</script>')
            with h5py.File(job / "r.h5", "w") as file:
                file.attrs["seconds"], file.attrs["git"] = seconds, revision
                file.create_dataset("a/pmax", data=[1.0, number])
            with zipfile.ZipFile(job / "w.fmu", "w") as archive:
                archive.writestr("binaries/a.so", revision)
                archive.writestr("resources/case.toml", f"load = {number}")

        write(sides[0], "aaaaaaa", 0.7, 1)
        write(sides[1], "bbbbbbb", 3.1, 1)
        assert not list(differences(*sides)), "times and revisions are masked"
        write(sides[1], "bbbbbbb", 3.1, 2)
        (sides[1] / "job/new").write_text("")
        found = list(differences(*sides))
        assert [line.split(":")[0] for line in found] == [f"job/{name}" for name in ("new", "p.html", "r.h5", "r.json", "w.fmu")], found
        assert found[2].endswith("1 of 2 values differ, first a/pmax"), found[2]
    print("every verb is run, every difference is seen")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("run")
    one.add_argument("program")
    one.add_argument("folder", type=pathlib.Path)
    one.add_argument("--only", default="")
    one.add_argument("--jobs", type=int, default=os.cpu_count())
    two = commands.add_parser("diff")
    two.add_argument("before", type=pathlib.Path)
    two.add_argument("after", type=pathlib.Path)
    commands.add_parser("self-test")
    said = parser.parse_args()
    if said.command == "self-test":
        return self_test()
    if said.command == "diff":
        found = list(differences(said.before, said.after))
        print("\n".join(found) or "all outputs are the same")
        return 1 if found else 0
    program = str(pathlib.Path(said.program).resolve())
    said.folder.mkdir(parents=True, exist_ok=True)
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
    (said.folder / "revision").write_text(re.search(r"\((\w+)\)", version).group(1))
    with concurrent.futures.ThreadPoolExecutor(said.jobs) as pool:
        wanted = [(n, c) for n, c in jobs() if re.search(said.only, n)]
        for name, statuses in pool.map(lambda job: run(program, *job, said.folder), wanted):
            print(name, *statuses, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
