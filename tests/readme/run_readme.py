#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""What README.md tells to begin with, done: its case of at most 12 lines with a profile of two columns, and its two commands.

usage: run_readme.py ROOT PROGRAM
"""
import math
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

root, program = map(pathlib.Path, sys.argv[1:])
readme = (root / "README.md").read_text()
case = re.search(r"```toml\n(.*?)```", readme, re.S).group(1)
assert len(case.splitlines()) <= 12, "the case of README.md is longer than 12 lines"
commands = [line for line in re.search(r"```toml\n.*?```\n+```\n(.*?)```", readme, re.S).group(1).splitlines() if line]
assert len(commands) == 2, commands
said_time, said_size = (float(number) for number in re.search(r"([\d.]+) s of processor time and writes a report of ([\d.]+) MB", readme).groups())

with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    (folder / "my.toml").write_text(case)
    # A cone of 1:20 with a flange, as an engineer may have measured it.
    points = [(-70 + 0.5 * i, 27 * math.exp(-(((-70 + 0.5 * i) + 56) / 9) ** 2) - (-70 + 0.5 * i) / 20) for i in range(261)]
    (folder / "wheel.csv").write_text("".join(f"{y:.3f},{z:.5f}\n" for y, z in points))
    environment = {**os.environ, "PATH": f"{program.parent}:{os.environ['PATH']}"}
    for command in commands:
        done = subprocess.run(command.split(), cwd=folder, env=environment, capture_output=True, text=True)
        assert done.returncode == 0, f"{command}: {done.stdout}{done.stderr}"
        print(done.stdout)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    assert used.ru_utime + used.ru_stime < 20 * said_time, f"{used.ru_utime + used.ru_stime} s"
    report = folder / "my.html"
    if report.exists():
        assert 0.5 < report.stat().st_size / 1e6 / said_size < 1.5, f"the report has {report.stat().st_size / 1e6:.2f} MB"
    else:
        sys.exit("the commands write no report")
