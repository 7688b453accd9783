#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""How long after Ctrl-C the program is gone: long commands of each verb, stopped at random moments; and whether what
stands under its target's name is the old file, the new one, or results that say themselves that they are not complete.

  scripts/interrupt-times.py PROGRAM [--each 20] [--only NAME ...] [--stacks SECONDS]

On a loaded machine the time of the processors counts, of all threads together, not the time that passes.
--stacks prints where a run is (gdb) that is not gone SECONDS after the signal, and ends it. Prints a table; exits with 1 where a
target was not whole.
"""
import argparse
import hashlib
import json
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

PAIR = """
[wheel]
shape.standard = "S1002"
[rail]
shape.standard = "60E1"
[track]
cant = "1:40"
[wheelset]
vertical_force_N = 80e3
velocity_m_s = 2
vpitch_rad_s = -4.3
"""
FILES = {
    "pair.toml": PAIR + "[discretisation]\ndx_mm = 0.5\nds_mm = 0.5\n",
    "conformal.toml": PAIR.replace("vpitch", "y_mm = 5.5\nvpitch")
    + "[contact]\nreference_surface = \"curved\"\n[discretisation]\ndx_mm = 0.05\nds_mm = 0.05\nmax_elements = 200000\n",
    "table.toml": PAIR.replace("vpitch", "y_mm = 5.5\nvpitch")
    + "[contact]\nreference_surface = \"curved\"\n[influence]\nkind = \"angle_corrected\"\ninclination_fit = \"table\"\n"
      "[discretisation]\ndx_mm = 0.1\nds_mm = 0.1\nmax_elements = 200000\n",
    "fine.toml": PAIR + "[discretisation]\ndx_mm = 0.03\nds_mm = 0.03\nmax_elements = 1000000\n",
    "waves.toml": PAIR + "[[rail.corrugations]]\nx_start_mm = -500.0\nx_end_mm = 500.0\nramp_mm = 75.0\n"
                         "y_center_mm = -5.0\nwidth_mm = 80.0\nwaves = [{ wavelength_mm = 50.0, amplitude_um = 30.0 }]\n",
    "several.toml": PAIR + "[[rail.squats]]\nlength_mm = 40.0\nwidth_mm = 30.0\ndepth_mm = 0.35\nx_center_mm = 15.0\n"
                           "y_center_mm = -8.0\n[discretisation]\ndx_mm = 0.1\nds_mm = 0.1\n"
                           "[[cases]]\nwheelset.s_mm = [-20, -10, 0, 10, 20]\n",
    "study.toml": "[study]\ntitle = \"Studied\"\nbase = \"several.toml\"\n[[study.vary]]\nkey = \"wheelset.y_mm\"\n"
                  "values = [0, 1, 2, 3, 4, 5]\n",
}
BIG = "--resolution 0.12 --range-mm=-150,150"
PREPARE = [
    "scan waves.toml -o scan.ply --body rail --range-mm -250 250 --points 600000 --noise-mm 0.01",
    "scan waves.toml -o scan.xyz --body rail --range-mm -250 250 --points 600000 --noise-mm 0.01",
    "convert waves.toml mesh.ply --body rail --resolution 0.1 --range-mm=-200,200",
    "convert waves.toml slices.slcs --body rail --resolution 0.5 --range-mm=-200,200",
    "run fine.toml -o result --set discretisation.dx_mm=0.05 --set discretisation.ds_mm=0.05",
    "convert 60E1 rail.step --range-mm=-200,200",
    "simulate {repository}/examples/flat-at-speed.toml -o simulated --set simulation.distance_m=0.7",
]
EXAMPLES = "{repository}/examples"
SIMULATION = f"{EXAMPLES}/flat-at-speed.toml"
ROWS = {  # name: command, target
    "run, one conformal case, 0.05 mm": ("run conformal.toml -o @", "out"),
    "run, table of inclinations, 0.1 mm": ("run table.toml -o @", "out"),
    "run, planar, 0.03 mm": ("run fine.toml -o @", "out"),
    "run, on a mesh": ("run waves.toml --rail-backend mesh --resolution 0.12 -o @", "out"),
    "run, on flat triangles": ("run waves.toml --rail-backend mesh-flat --resolution 0.12 -o @", "out"),
    "run, on offsets": ("run waves.toml --rail-backend offset --resolution 0.12 -o @", "out"),
    "run, on slices": ("run waves.toml --rail-backend spline --resolution 0.12 -o @", "out"),
    "run, on a NURBS": ("run waves.toml --rail-backend nurbs --resolution 0.12 -o @", "out"),
    "run, report": ("run fine.toml --report @ --set discretisation.dx_mm=0.05 --set discretisation.ds_mm=0.05", "out.html"),
    "convert shape to mesh": (f"convert waves.toml @ --body rail {BIG}", "out.ply"),
    "convert shape to text mesh": (f"convert waves.toml @ --body rail {BIG}", "out.obj"),
    "convert shape to offsets": (f"convert waves.toml @ --body rail {BIG}", "out.vdb"),
    "convert shape to slices": (f"convert waves.toml @ --body rail {BIG}", "out.slcs"),
    "convert mesh to offsets": (f"convert mesh.ply @ --body rail {BIG}", "out.vdb"),
    "convert mesh to slices": (f"convert mesh.ply @ --body rail {BIG}", "out.slcs"),
    "convert slices to mesh": (f"convert slices.slcs @ --body rail {BIG}", "out.ply"),
    "import points to slices": ("import scan.ply -o @ --body rail", "out.slcs"),
    "import points to mesh": ("import scan.ply -o @ --body rail --resolution 0.1", "out.ply"),
    "import points to free mesh": ("import scan.ply -o @ --body rail --set fit.mesh=free", "out.ply"),
    "import points to offsets": ("import scan.ply -o @ --body rail --resolution 0.1", "out.vdb"),
    "import text": ("import scan.xyz -o @ --body rail --unit mm", "out.slcs"),
    "scan": ("scan waves.toml -o @ --body rail --range-mm -250 250 --points 1000000 --noise-mm 0.01", "out.ply"),
    "compare": ("compare several.toml --resolutions 0.2 -o @", "out"),
    "bench": ("bench pair.toml --resolutions 0.2 -o @", "out"),
    "sweep": ("sweep study.toml -o @", "out"),
    "simulate": (f"simulate {SIMULATION} -o @", "out"),
    "check": ("check waves.toml --set rail.backend=mesh --set rail.resolution_mm=0.05 -o @", "out"),
    "report": ("report result -o @", "out.html"),
    "plot": ("plot result --what pressure -o @", "out.svg"),
    "report of two": ("report result result -o @", "out.html"),
    "live": ("live pair.toml --no-open -o @", "out.html"),  # needs the program for browsers: scripts/web.sh
    "convert CAD to mesh": (f"convert rail.step @ --body rail {BIG}", "out.ply"),
    "convert to CAD": (f"convert waves.toml @ --body rail {BIG}", "out.step"),
    "trace": ("trace slices.slcs --line-mm 0 --step 0.01 -o @", "out.csv"),
    "geometry": ("geometry --wheel S1002 --rail 60E1 --gauge-mm 1435 --cant 1:40 --step-mm 0.005 --amplitudes-mm 1:9:0.01 --json @", "out.json"),
    "geometry of a mesh": ("geometry waves.toml --backend mesh --resolution 0.12 --step-mm 0.02 --json @", "out.json"),
    "measure": ("measure rail mesh.ply --nominal 60E1 --json @", "out.json"),
    "measure points": ("measure rail scan.ply --nominal 60E1 --json @", "out.json"),
    "assess": ("assess simulated --json @", "out.json"),
    "stability": (f"stability {SIMULATION} --set simulation.wheels=[] --from 5 --to 100 --count 400 -o @", "out"),
    "stability, falling": (f"stability {SIMULATION} --set simulation.wheels=[] --falling -o @", "out"),
    "response": (f"response {SIMULATION} --set simulation.wheels=[] --count 4000 -o @", "out"),
    "track": (f"track {EXAMPLES}/tracks/gm-tt0088.toml --fit 3 --count 2000 -o @", "out"),
    "fmu": ("fmu pair.toml -o @", "out.fmu"),
    "evolve": (f"evolve {EXAMPLES}/hollow-wheel.toml -o @", "out"),
    "design": (f"design {EXAMPLES}/ground-rail.toml -o @", "out"),
}
# What only reads and prints ends at once.
PRINTING = {"diff", "conform", "new", "list", "schema", "completion", "man"}
OLD = b"what was there before\n"
LONGEST = 10.0  # of the moments at which the signal comes [s]


def words(command, target):
    repository = pathlib.Path(__file__).resolve().parent.parent
    return [w.replace("{repository}", str(repository)).replace("@", str(target)) if "@" in w or "{" in w else w
            for w in command.split()]


def start(program, command, folder, target):
    environment = dict(os.environ, TMPDIR=str(folder))
    return subprocess.Popen([program, *words(command, target)], cwd=folder, env=environment,
                            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))  # not that of a background


def time_of_children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def time_so_far(process):
    """Processor time that a running process has taken [s]."""
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def clean(out):
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir()


def broken(out, target, made):
    """What is wrong with what is there; None: nothing. made: hashes of the new files that this command has made."""
    left = [p.name for p in out.rglob(".*.part*")]
    if left:
        return f"left {left[0]}"
    path = out / target
    if target.endswith(".html"):  # tells times, so that no two are alike
        data = path.read_bytes()
        return None if data == OLD or data.rstrip().endswith(b"</html>") else "a part of a page"
    if "." in target:
        data = path.read_bytes()
        if data != OLD:
            made.add(hashlib.sha256(data).hexdigest())
        return None if len(made) < 2 else "neither the old file nor the new one"
    for name in ("result.json", "compare.json", "bench.json"):
        if (path / name).exists():
            json.loads((path / name).read_text())
    return None


def measure(program, name, folder, arguments):
    command, target = ROWS[name]
    out = folder / "out"
    delays, work, faults, stacks, made, longest_moment = [], [], [], [], set(), LONGEST
    for _ in range(3 * arguments.each):
        if len(delays) == arguments.each:
            break
        clean(out)
        if "." in target:
            (out / target).write_bytes(OLD)
        begin, before = time.monotonic(), time_of_children()
        run = start(program, command, folder, out / target)
        try:
            run.wait(timeout=random.uniform(0.02, longest_moment))
        except subprocess.TimeoutExpired:
            pass
        if run.poll() is not None:  # over before the signal
            if run.returncode not in (0, 1, 4):
                return f"| {name} | does not run: exit status {run.returncode} |", False
            longest_moment = min(longest_moment, time.monotonic() - begin)
            continue
        sent, taken = time.monotonic(), time_so_far(run)
        run.send_signal(signal.SIGINT)
        if arguments.stacks:
            try:
                run.wait(timeout=arguments.stacks)
            except subprocess.TimeoutExpired:
                text = subprocess.run(["gdb", "-p", str(run.pid), "-batch", "-ex", "bt 8"], capture_output=True,
                                      text=True).stdout
                run.send_signal(signal.SIGINT)  # the second one ends it at once
                stacks.append("\n".join(line[:170] for line in text.splitlines() if line.startswith("#"))[:3500])
        run.wait()
        delays.append(time.monotonic() - sent)
        work.append(time_of_children() - before - taken)
        if (fault := broken(out, target, made)) is not None:
            faults.append(fault)
    delays.sort()
    middle = delays[len(delays) // 2] if delays else float("nan")
    worst = delays[-1] if delays else float("nan")
    most = max(work, default=float("nan"))
    row = (f"| {name} | {longest_moment:.1f} | {len(delays)} | {middle:.2f} | {worst:.2f} | {most:.2f} | "
           f"{sum(d > 0.5 for d in delays)} | {'; '.join(sorted(set(faults))) or 'whole'} |")
    return row + "".join("\n" + s + "\n" for s in stacks), not faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--each", type=int, default=20)
    parser.add_argument("--only", nargs="*", default=[])
    parser.add_argument("--stacks", type=float)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folder", help="keep the input files here")
    arguments = parser.parse_args()
    random.seed(arguments.seed)
    program = str(pathlib.Path(arguments.program).resolve())
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(arguments.folder or temporary).resolve()
        folder.mkdir(exist_ok=True)
        for name, text in FILES.items():
            (folder / name).write_text(text)
        verbs = subprocess.run([program, "list", "verbs"], capture_output=True, text=True, check=True).stdout
        bare = {line.split()[0] for line in verbs.splitlines() if re.match(r"\w", line.strip())} - PRINTING - {c.split()[0] for c, _ in ROWS.values()}
        if bare:
            sys.exit(f"no command here stops {', '.join(sorted(bare))}")
        chosen = [name for name in ROWS if not arguments.only or any(o in name for o in arguments.only)]
        needed = {word for name in chosen for word in ROWS[name][0].split()}
        for command in PREPARE:
            done = folder / (command.split()[0] + "-" + str(PREPARE.index(command)) + ".done")
            given = command.split()
            made = given[given.index("-o") + 1] if "-o" in given else given[2]
            if made in needed and not done.exists():
                run = subprocess.run([program, "--quiet", *words(command, "")], cwd=folder, stdout=subprocess.DEVNULL)
                if run.returncode > 1:
                    sys.exit(f"{command}: exit status {run.returncode}")
                done.touch()
        print("| command | signals within [s] | of them | middle [s] | longest [s] | longest [s of processors] | over 0.5 s | targets |\n|---|---|---|---|---|---|---|---|")
        good = True
        for name in chosen:
            row, fine = measure(program, name, folder, arguments)
            good = good and fine
            print(row, flush=True)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
