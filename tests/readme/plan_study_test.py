#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""scripts/plan-study.py against schedules worked out by hand, and against a folder with planted times.

usage: plan_study_test.py ROOT
"""
import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile

script = pathlib.Path(sys.argv[1]) / "scripts" / "plan-study.py"
spec = importlib.util.spec_from_file_location("plan_study", script)
plan = importlib.util.module_from_spec(spec)
spec.loader.exec_module(plan)

# Ten tasks of ten equal runs in five slots: two rounds.
assert plan.schedule([10.0] * 100, 10, 5, start=1.0) == (202.0, 1010.0)
# Three tasks in two slots: the second slot takes the third when it is free first.
assert plan.schedule([5.0, 1.0, 2.0], 3, 2) == (5.0, 8.0)
# More slots than tasks help nobody.
assert plan.schedule([4.0, 4.0], 1, 8) == (8.0, 8.0)
# With failures all work is done, and costs more.
wall, busy = plan.schedule([10.0] * 100, 10, 5, start=1.0, failures=1 / 300, checkpoint=2.0)
assert wall > 202.0 and 1010.0 < busy < 1.5 * 1010.0, (wall, busy)

with tempfile.TemporaryDirectory() as name:
    for number, seconds in ((1, 30.0), (2, 50.0)):
        run = pathlib.Path(name) / "runs" / f"run_{number:04}"
        run.mkdir(parents=True)
        (run / "lock").touch()
        (run / "simulation.h5").write_bytes(bytes(1000))
        os.utime(run / "lock", (1e9, 1e9))
        os.utime(run / "simulation.h5", (1e9 + seconds, 1e9 + seconds))
    said = subprocess.run([sys.executable, script, name, "--runs", "1000", "--slots", "10", "--tasks", "100"], capture_output=True, text=True).stdout
    assert "2 runs, 40 s each (30 to 50)" in said and "0.001 GB" in said, said
    empty = subprocess.run([sys.executable, script, name + "/runs", "--runs", "9", "--slots", "1"], capture_output=True, text=True)
    assert empty.returncode == 1 and "fewer than two finished runs" in empty.stderr
