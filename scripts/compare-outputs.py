#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Whether a change leaves every output as it was: runs the examples, and the inputs in a shared folder where there is one, with a program
and compares all files and texts byte for byte with those of another program. Times and the revision are masked in texts; of HDF5 files, which hold
times too, only the sizes are compared, and reports (HTML) not at all: they show what the other files hold.

usage: compare-outputs.py run PROGRAM FOLDER [--only PATTERN] [--jobs N]    keeps the outputs of a program
       compare-outputs.py diff BEFORE AFTER                                what differs; exit status 1 when something does

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

ROOT = pathlib.Path(__file__).resolve().parent.parent
SHARED = pathlib.Path(os.environ.get("TREADMARK_SHARED", ROOT.parent / "shared"))
SWEEPS = ("figure5", "figure6", "figure6-track", "figure7", "flat-between-sleepers")  # many runs, minutes to hours
MASKS = [
    (rb'("(?:seconds|(?:build|distance|normal|search|tangential|total)_s)": ?)[-+.e0-9]+', rb"\1#"),
    (rb"^(case [^\n]*, )[0-9.]+ s$", rb"\1# s"),
    (rb"^time: [^\n]*$", b"time: #"),
]


def jobs():
    """Name and arguments of each run; OUT stands for its folder."""
    for verb in "run compare bench convert import scan simulate sweep report plot check list schema".split():
        yield f"help-{verb}", [verb, "--help"]
    yield "help", ["--help"]
    yield "schema", ["schema"]
    for topic in "backends defects laws profiles solvers verbs nonsense".split():
        yield f"list-{topic}", ["list", topic]
    results = ["-o", "OUT/results", "--json", "OUT/result.json", "--report", "OUT/report.html"]
    for case in sorted((ROOT / "examples").glob("*.toml")):
        text = case.read_text()
        if case.stem in SWEEPS:
            yield f"check-{case.stem}", ["check", str(case)]
        elif "[evolve]" in text:
            yield f"check-{case.stem}", ["check", str(case)]
        elif "[simulation]" in text:
            yield f"simulate-{case.stem}", ["simulate", str(case), "-o", "OUT/results", "--report", "OUT/report.html"]
        else:
            yield f"run-{case.stem}", ["run", str(case), *results]
    flat = str(ROOT / "examples/wheel-flat.toml")
    squat = str(ROOT / "examples/squat.toml")
    yield "compare-squat", ["compare", squat, "-o", "OUT/results", "--report", "OUT/report.html"]
    yield "scan-flat", ["scan", flat, "--body", "wheel", "-o", "OUT/scan.ply", "--noise-mm", "0.03", "--frame", "random"]
    for folder in ("contact_examples", "contact_testbank"):
        for case in sorted((SHARED / "data" / folder).glob("**/*.inp")):
            yield f"inp-{case.stem}", ["run", str(case), *results]


def run(program, name, arguments, folder):
    out = folder / name
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    done = subprocess.run([program, "--threads", "1", "--quiet", *(a.replace("OUT", ".", 1) if a.startswith("OUT") else a for a in arguments)],
                          cwd=out, capture_output=True)
    (out / "stdout").write_bytes(done.stdout.replace(program.encode(), b"PROGRAM"))
    (out / "stderr").write_bytes(done.stderr.replace(program.encode(), b"PROGRAM"))
    (out / "status").write_text(f"{done.returncode}\n")
    return name, done.returncode


def masked(data, revision):
    if revision:
        data = data.replace(revision, b"0000000")
    for pattern, text in MASKS:
        data = re.sub(pattern, text, data, flags=re.MULTILINE)
    return data


def differences(before, after):
    revisions = [(folder / "revision").read_bytes().strip() for folder in (before, after)]
    names = sorted({p.relative_to(f) for f in (before, after) for p in f.rglob("*") if p.is_file()} - {pathlib.Path("revision")})
    for name in names:
        old, new = before / name, after / name
        if not old.exists() or not new.exists():
            yield f"{name}: only {'before' if old.exists() else 'after'}"
        elif name.suffix == ".html":
            continue
        elif name.suffix == ".h5":
            if old.stat().st_size != new.stat().st_size:
                yield f"{name}: {old.stat().st_size} bytes before, {new.stat().st_size} after"
        elif masked(old.read_bytes(), revisions[0]) != masked(new.read_bytes(), revisions[1]):
            yield f"{name}: differs"


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
    said = parser.parse_args()
    if said.command == "diff":
        found = list(differences(said.before, said.after))
        print("\n".join(found) or "all outputs are the same")
        return 1 if found else 0
    program = str(pathlib.Path(said.program).resolve())
    said.folder.mkdir(parents=True, exist_ok=True)
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
    (said.folder / "revision").write_text(re.search(r"\((\w+)\)", version).group(1))
    with concurrent.futures.ThreadPoolExecutor(said.jobs) as pool:
        wanted = [(n, a) for n, a in jobs() if re.search(said.only, n)]
        for name, status in pool.map(lambda job: run(program, *job, said.folder), wanted):
            print(name, status, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
