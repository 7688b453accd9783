#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Measures Treadmark against another program on the same inputs, in turns, so that a busy machine slows both.

  scripts/side-by-side.py --peer PATH INPUT...      wall clock and processor time of both, and how many times as fast
  scripts/side-by-side.py --self-test               Treadmark against a script that runs it twice: the ratio must be two

Every input is run by Treadmark, then by the peer, then by Treadmark again, and so on (--rounds, after one round that
does not count). Processor time is that of the process and all it waited for, user and system. A ratio is peer over
Treadmark of one round; printed are the median and the least and greatest of the rounds.

The peer is started with --peer-arguments, in which {input} is the input's name and {stem} the name without its ending.
Both programs run in a folder of links to all that lies beside the input, so that what they write is thrown away.
"""
import argparse
import json
import os
import pathlib
import shlex
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
SELF_TEST_CASE = ROOT / "examples/corrugation.toml"


def linked(source, folder):
    """Links to all files and folders beside an input."""
    for entry in source.resolve().parent.iterdir():
        (folder / entry.name).symlink_to(entry)


def measured(command, folder):
    """(wall, processor) seconds of a command. Ends this program where the command fails."""
    with tempfile.TemporaryFile() as output:
        start = time.perf_counter()
        process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            output.seek(0)
            tail = output.read()[-2000:].decode(errors="replace")
            sys.exit(f"{shlex.join(map(str, command))} ended with {process.returncode}:\n{tail}")
    return wall, usage.ru_utime + usage.ru_stime


def spread(values):
    return {"median": statistics.median(values), "least": min(values), "greatest": max(values)}


def compare(program, arguments, peer, peer_arguments, source, rounds):
    """Times of both programs on one input, and their ratios."""
    fill = {"input": source.name, "stem": source.stem}
    commands = [[program] + [a.format(**fill) for a in arguments], [peer] + [a.format(**fill) for a in peer_arguments]]
    times = [[], []]
    for turn in range(rounds + 1):
        for which, command in enumerate(commands):
            with tempfile.TemporaryDirectory() as folder:
                linked(source, pathlib.Path(folder))
                seconds = measured(command, folder)
            if turn > 0:
                times[which].append(seconds)
    result = {"input": str(source)}
    for k, clock in enumerate(("wall", "processor")):
        ours, theirs = ([t[k] for t in of_one] for of_one in times)
        result[clock] = {"treadmark_s": statistics.median(ours), "peer_s": statistics.median(theirs),
                         "ratio": spread([b / a for a, b in zip(ours, theirs)])}
    return result


def show(result):
    for clock in ("processor", "wall"):
        r = result[clock]
        ratio = r["ratio"]
        print(f"{result['input']}  {clock:9}  treadmark {r['treadmark_s']:.3f} s  peer {r['peer_s']:.3f} s  "
              f"ratio {ratio['median']:.2f} ({ratio['least']:.2f} to {ratio['greatest']:.2f})", flush=True)


def self_test(options):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        twice, broken = folder / "twice", folder / "broken"
        run = shlex.join([str(options.program)] + [a.format(input=SELF_TEST_CASE.name) for a in options.arguments])
        twice.write_text(f"#!/bin/sh\nset -e\n{run}\n{run}\n")
        broken.write_text("#!/bin/sh\nexit 3\n")
        for script in (twice, broken):
            script.chmod(0o755)
        result = compare(options.program, options.arguments, twice, [], SELF_TEST_CASE, options.rounds)
        show(result)
        ratio = result["processor"]["ratio"]["median"]
        if not 1.6 < ratio < 2.6:  # the shell itself costs a little
            sys.exit(f"running a program twice should cost two times as much, not {ratio:.2f} times")
        try:
            measured([str(broken)], folder)
        except SystemExit:
            print("a peer that fails is told of: yes")
            return
        sys.exit("a peer that fails is not told of")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("inputs", nargs="*", type=pathlib.Path, metavar="INPUT")
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/app/treadmark")
    parser.add_argument("--arguments", type=shlex.split, default=shlex.split("run {input} --threads 1"))
    parser.add_argument("--peer", type=pathlib.Path)
    parser.add_argument("--peer-arguments", type=shlex.split, default=["{input}"])
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--json", type=pathlib.Path, help="write all numbers here")
    parser.add_argument("--self-test", action="store_true")
    options = parser.parse_args()
    options.program = options.program.resolve()
    if options.rounds < 1:
        parser.error("--rounds must be at least 1")
    if options.self_test:
        return self_test(options)
    if not options.peer or not options.inputs:
        parser.error("give --peer PATH and at least one INPUT, or --self-test")
    results = []
    for source in options.inputs:
        results.append(compare(options.program, options.arguments, options.peer.resolve(), options.peer_arguments, source,
                               options.rounds))
        show(results[-1])
    if options.json:
        options.json.write_text(json.dumps(results, indent=1) + "\n")


if __name__ == "__main__":
    main()
