#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""scripts/scaling-model.py against times worked out by hand, and its reader against a planted file.

usage: scaling_model_test.py ROOT
"""
import importlib.util
import pathlib
import sys

spec = importlib.util.spec_from_file_location("scaling_model", pathlib.Path(sys.argv[1]) / "scripts" / "scaling-model.py")
scaling = importlib.util.module_from_spec(spec)
spec.loader.exec_module(scaling)


def near(found, seconds, limit):
    assert abs(found[0] - seconds) < 1e-12 and found[1] == limit, (found, seconds, limit)


# 1 s outside loops, tasks of at most 0.5 s, 8.5 s more of tasks, 1000 loops.
job = {"work_s": 10.0, "span_s": 1.5, "in_tasks_s": 0.5, "loops": 1000}
near(scaling.model(job, 1, 1e9, 1e-5), 10.0, "shared work")  # one core starts no loops
near(scaling.model(job, 2, 1e9, 1e-5), 5.76, "shared work")
near(scaling.model(job, 85, 1e9, 1e-5), 1.61, "outside loops")
near(scaling.model(job, 85, 1e9, 2e-3), 3.6, "starting loops")
near(scaling.model({**job, "span_s": 1.0, "in_tasks_s": 0.9}, 90, 1e9, 0.0), 1.1, "longest tasks")
near(scaling.model({**job, "bytes": 3e9}, 85, 1e9, 1e-5), 3.0, "memory")
near(scaling.model({**job, "bytes": 1e9}, 85, 1e9, 1e-5), 1.61, "outside loops")
# Lines read, of instructions too, and lines written, which are read before and written back.
text = "desc: D1\nevents: Ir I1mr ILmr Dr D1mr DLmr Dw D1mw DLmw\nfn=f\n1 1 1 1 1 1 1 1 1 1\nsummary: 1000 50 3 400 30 5 200 20 7\n"
assert scaling.cachegrind_bytes(text) == 64 * (3 + 5 + 14)
