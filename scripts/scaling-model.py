#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""What many cores would give, simulated from one thread, and what two really give.

  scripts/scaling-model.py                        a table of the verbs, in Markdown
  scripts/scaling-model.py --only import --cores 8,64 --bandwidth-GB-s 50
  scripts/scaling-model.py --self-test            the measured program against its own processor time

Each job is run by build/release/bench/scaling/bench_scaling, the program with loops whose tasks are done one after the other and
measured (so the load of the machine hardly matters). It tells work W (processor time of everything) and span S (of the longest chain
that cannot be shared, as if there were a core for every task): time outside loops, and the longest task of each loop. A greedy schedule
on p cores takes at most
    T(p) = S + (W - S) / p + loops on the chain x what starting one takes          (Graham 1969; Brent 1974)
and no less than its traffic with memory over the bandwidth of all cores. Traffic: misses of a last-level cache of --cache-MiB a core
that cachegrind (valgrind) simulates, lines read and lines written back; --no-memory leaves that out, which takes most of the time.
Bandwidth and the cost of a loop are assumptions about the machine; give those of yours.

The efficiency on two cores is wall clock on one thread over twice that on two, least of --rounds runs each in turns; on a machine that
others use it is too low. --no-times leaves it out.
"""
import argparse
import json
import os
import pathlib
import resource
import shlex
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / "build/release"
WHEELS = "".join(f'[[simulation.wheels]]\nwheelset = {n}\nside = "{side}"\ncontact = "full"\n\n' for n in (1, 2, 3, 4) for side in ("left", "right"))


def all_wheels(folder):
    """The example of a flat at speed with full contact at all wheels, for a few milliseconds."""
    text = (ROOT / "examples/flat-at-speed.toml").read_text()
    first, last = text.index("[[simulation.wheels]]"), text.index("[case]")
    text = text[:first] + WHEELS + text[last:]
    for name in ("vehicles", "tracks"):
        text = text.replace(f'"{name}/', f'"{ROOT}/examples/{name}/')
    (folder / "wheels.toml").write_text(text)


def one_patch(folder):
    """A wheel on a squat at one place, on fine elements."""
    text = (ROOT / "examples/squat.toml").read_text()
    text = text[:text.index("# Over both dips")] + "[[cases]]\nwheelset.s_mm = 15\n"
    (folder / "patch.toml").write_text(text)


SCAN = "scan {examples}/wheel-flat.toml --body wheel -o wheel.ply --points 200000 --noise-mm 0.02"
# Name, what it is, arguments, what makes its input (arguments of the program, or a function of the folder).
JOBS = [
    ("run", "13 positions over a flat", "run {examples}/wheel-flat.toml", None),
    ("run-files", "the same with all files of results", "run {examples}/wheel-flat.toml -o out", None),
    ("compare", "a squat, spline and mesh of 1 mm", "compare {examples}/squat.toml --backends spline,mesh --bodies rail --resolutions 1 -o out", None),
    ("bench", "spline and mesh of the built-in case", "bench --backends spline,mesh --resolutions 1 --seconds-per-measure 0.02 -o out", None),
    ("import", "200 000 points of a wheel into slices", "import wheel.ply --body wheel --resolution 1 -o out.slcw", SCAN),
    ("import-triangles", "the same into triangles", "import wheel.ply --body wheel --resolution 1 -o out.ply", SCAN),
    ("simulate", "full contact at 8 wheels, 10 mm", "simulate wheels.toml --set simulation.distance_m=0.01 -o out", all_wheels),
    ("large", "one patch of 110 000 elements",
     "run patch.toml --set discretisation.dx_mm=0.03 --set discretisation.ds_mm=0.03 --set discretisation.max_elements=1000000", one_patch),
]


def arguments(text, folder):
    return shlex.split(text.format(examples=ROOT / "examples", folder=folder))


def run(program, words, folder, **environment):
    """(wall, processor) seconds. Ends this program where the command fails."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    done = subprocess.run([*map(str, program), *words], cwd=folder, env={**os.environ, "TREADMARK_CACHE": "off", **environment},
                          stdin=subprocess.DEVNULL, capture_output=True, text=True)
    wall, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        sys.exit(f"{shlex.join([*map(str, program), *words])} ended with {done.returncode}:\n{(done.stdout + done.stderr)[-2000:]}")
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def strands(measured, words, folder, threads):
    """What the measured program tells of a job, and its processor time."""
    file = pathlib.Path(folder) / "strands.json"
    _, processor = run([measured], [*words, "--quiet", "--threads", str(threads)], folder, TREADMARK_STRANDS=str(file))
    return json.loads(file.read_text()), processor


def traffic(program, words, folder, cache):
    """Bytes that a last-level cache of so many bytes exchanges with memory."""
    file = pathlib.Path(folder) / "cachegrind"
    run(["valgrind", "--tool=cachegrind", "--cache-sim=yes", f"--LL={cache},16,64", f"--cachegrind-out-file={file}", program],
        [*words, "--quiet", "--threads", "1"], folder)
    return cachegrind_bytes(file.read_text())


def cachegrind_bytes(text):
    values = {line.split(":")[0]: line.split()[1:] for line in text.splitlines() if line.startswith(("events:", "summary:"))}
    misses = dict(zip(values["events"], map(int, values["summary"])))
    return 64 * (misses["ILmr"] + misses["DLmr"] + 2 * misses["DLmw"])


def model(job, cores, bandwidth, loop_s):
    """Seconds on so many cores, and what the most of them are spent on."""
    work, span, in_tasks = job["work_s"], job["span_s"], job["in_tasks_s"]
    parts = {"outside loops": span - in_tasks, "longest tasks": in_tasks, "shared work": (work - span) / cores,
             "starting loops": job["loops"] * loop_s if cores > 1 else 0.0}
    compute, memory = sum(parts.values()), job.get("bytes", 0.0) / bandwidth
    if memory > compute:
        return memory, "memory"
    return compute, max(parts, key=parts.get)


def measure(name, text, make, options):
    with tempfile.TemporaryDirectory() as folder:
        if callable(make):
            make(pathlib.Path(folder))
        elif make:
            run([options.program], [*arguments(make, folder), "--quiet"], folder)
        words = arguments(text, folder)
        print(f"{name} ...", file=sys.stderr, flush=True)
        job, _ = strands(options.measured, words, folder, max(options.cores))
        if options.memory:
            job["bytes"] = traffic(options.program, words, folder, int(options.cache_MiB * 2**20))
        if options.times:
            one, two = [], []
            for _ in range(options.rounds):
                for threads, times in ((1, one), (2, two)):
                    times.append(run([options.program], [*words, "--quiet", "--threads", str(threads)], folder)[0])
            job["wall_s"] = {"1": min(one), "2": min(two)}
        return job


def row(name, what, job, options):
    cells = [f"{name}: {what}", f"{job['work_s']:.3g}", f"{job['span_s'] - job['in_tasks_s']:.3g}", f"{job['in_tasks_s']:.3g}", str(job["loops"]),
             f"{job['bytes'] / 1e9:.2g}" if "bytes" in job else "-"]
    two, _ = model(job, 2, options.bandwidth * 2 / max(options.cores), options.loop_us * 1e-6)
    cells.append(f"{job['work_s'] / (2 * two):.2f}")
    cells.append(f"{job['wall_s']['1'] / (2 * job['wall_s']['2']):.2f}" if "wall_s" in job else "-")
    for cores in options.cores:
        seconds, limit = model(job, cores, options.bandwidth, options.loop_us * 1e-6)
        cells += [f"{job['work_s'] / seconds:.1f}", limit]
    return "| " + " | ".join(cells) + " |"


def head(options):
    cells = ["job", "work [s]", "outside loops [s]", "longest tasks [s]", "loops", "memory [GB]", "efficiency on 2: model", "measured"]
    for cores in options.cores:
        cells += [f"times as fast on {cores}", "limit"]
    return "| " + " | ".join(cells) + " |\n|---|" + "--:|" * (len(cells) - 1)


def self_test(options):
    with tempfile.TemporaryDirectory() as folder:
        words = arguments("run {examples}/corrugation.toml -o out", folder)
        many, processor = strands(options.measured, words, folder, 64)
        one, _ = strands(options.measured, words, folder, 1)
        print(many, one, processor)
        if not 0.7 * processor < many["work_s"] <= 1.1 * processor:
            sys.exit("the work is not the processor time of the process")
        if not (many["in_tasks_s"] <= many["span_s"] < 0.9 * many["work_s"] and many["loops"] > 0):
            sys.exit("cases of a file are not shared")
        if one["loops"] != 0 or one["span_s"] != one["work_s"]:
            sys.exit("one thread shares loops")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=BUILD / "app/treadmark")
    parser.add_argument("--measured", type=pathlib.Path, default=BUILD / "bench/scaling/bench_scaling")
    parser.add_argument("--only", default="", help="names of jobs, separated by commas: " + ",".join(job[0] for job in JOBS))
    parser.add_argument("--cores", type=lambda text: [int(n) for n in text.split(",")], default=[64])
    parser.add_argument("--bandwidth-GB-s", dest="bandwidth", type=lambda text: float(text) * 1e9, default=200e9, help="of all cores; default 200")
    parser.add_argument("--loop-us", type=float, default=10.0, help="what starting a loop takes; default 10")
    parser.add_argument("--cache-MiB", dest="cache_MiB", type=float, default=4.0, help="last-level cache of a core, a power of two; default 4")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--no-memory", dest="memory", action="store_false")
    parser.add_argument("--no-times", dest="times", action="store_false")
    parser.add_argument("--json", type=pathlib.Path, help="write what was measured here")
    parser.add_argument("--self-test", action="store_true")
    options = parser.parse_args()
    options.program, options.measured = options.program.resolve(), options.measured.resolve()
    if options.self_test:
        return self_test(options)
    names = options.only.split(",") if options.only else [job[0] for job in JOBS]
    if unknown := [name for name in names if name not in [job[0] for job in JOBS]]:
        parser.error(f"no job is named {', '.join(unknown)}")
    load = os.getloadavg()[0]
    print(f"{os.cpu_count()} cores here, load of others {load:.1f}; assumed: {options.bandwidth / 1e9:g} GB/s, {options.loop_us:g} us a loop\n")
    print(head(options), flush=True)
    results = {}
    for name, what, text, make in JOBS:
        if name in names:
            results[name] = measure(name, text, make, options)
            print(row(name, what, results[name], options), flush=True)
    if options.json:
        options.json.write_text(json.dumps(results, indent=1) + "\n")


if __name__ == "__main__":
    main()
