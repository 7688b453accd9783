#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""What Python adds to a call of Pair.solve, over the same call by the library for C that asks for a result; and whether memory grows.

usage: PYTHONPATH=build/release/interfaces/python bench_python.py build/release/interfaces/c/libtreadmark.so [--calls N] [--growth N]

Checks first that both solve to the same bits. The times are medians of calls in turns, of the processor, on one thread.
"""
import argparse
import ctypes
import gc
import resource
import statistics
import sys
import time

import numpy as np

import treadmark as tm

CASE = """rail.shape.standard = "60E1"
wheel.shape.standard = "S1002"
track.cant = "1:40"
[wheelset]
vertical_force_N = 80e3
velocity_m_s = 20
vpitch_rad_s = -43.4
[discretisation]
dx_mm = 1
ds_mm = 1
"""
MOST_GROWTH = 2.0  # [MiB]


class InC:
    """The same pair by the functions of treadmark.h."""

    def __init__(self, library):
        self.tm = ctypes.CDLL(library)
        self.tm.tm_message.restype = ctypes.c_char_p
        self.case, self.pair, self.y = ctypes.c_void_p(), ctypes.c_void_p(), ctypes.c_int()
        text = CASE.encode()
        self.done(self.tm.tm_case_parse(text, ctypes.c_size_t(len(text)), None, 1, ctypes.byref(self.case)))
        self.done(self.tm.tm_pair_of_case(self.case, ctypes.byref(self.pair)))
        self.done(self.tm.tm_case_find_number(b"wheelset.y", ctypes.byref(self.y)))
        self.done(self.tm.tm_set_threads(1))

    def done(self, status):
        if status > 3:
            sys.exit(f"the library for C says: {self.tm.tm_message().decode()}")

    def solve(self, y):
        solution = ctypes.c_void_p()
        self.done(self.tm.tm_case_set_number_by_id(self.case, self.y, ctypes.c_double(y)))
        self.done(self.tm.tm_pair_solve(self.pair, self.case, ctypes.byref(solution)))
        return solution

    def force(self, solution):
        names, value = [b"force_on_rail.fx_tr", b"force_on_rail.fy_tr", b"force_on_rail.fz_tr"], ctypes.c_double()
        found = []
        for name in names:
            self.done(self.tm.tm_solution_number(solution, name, ctypes.byref(value)))
            found.append(value.value)
        return found

    def largest_pressure(self, solution):
        value = ctypes.c_double()
        self.done(self.tm.tm_patch_number(solution, ctypes.c_size_t(0), b"pmax", ctypes.byref(value)))
        return value.value

    def free(self, solution):
        self.tm.tm_solution_free(solution)


def memory():
    gc.collect()
    with open("/proc/self/statm") as pages:
        return int(pages.read().split()[1]) * resource.getpagesize() / 2**20


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("library")
    parser.add_argument("--calls", type=int, default=200)
    parser.add_argument("--growth", type=int, default=0, help="calls after which memory must not have grown")
    options = parser.parse_args()
    tm.set_threads(1)
    pair, other = tm.Pair.of_case(CASE), InC(options.library)

    for y in (0.0, 1e-3, 4e-3):
        solution = other.solve(y)
        mine = pair.solve(y=y)
        if list(mine.force) != other.force(solution) or mine.patches[0].pmax != other.largest_pressure(solution):
            sys.exit(f"at y = {y} they do not agree")
        other.free(solution)

    def timed(call, y):
        start = time.thread_time()
        call(y)
        return time.thread_time() - start

    def in_c(y):
        found = other.solve(y)
        other.largest_pressure(found)
        other.free(found)

    def in_c_apart(y):
        other.free(other.solve(y))

    def compared(by_python, by_c):
        python, c = [], []
        for k in range(options.calls):
            y = 1e-6 * (k % 100)
            for call, times in [(by_python, python), (by_c, c)][:: 1 if k % 2 else -1]:  # the second finds all warm
                times.append(timed(call, y))
        added = statistics.median(a - b for a, b in zip(python, c))
        print(f"a call by Python {1e6 * statistics.median(python):.0f} us, by C {1e6 * statistics.median(c):.0f} us, added {1e6 * added:.1f} us")

    print("a patch of 500 elements, which leaves no cache as it was:")
    compared(lambda y: pair.solve(y=y).patches[0].pmax, in_c)
    print("a wheel above the rail:")
    apart = pair.problem.replace(set={"wheelset.z_mm": -5.0})
    other.done(other.tm.tm_case_set(other.case, b"wheelset.z_mm=-5"))
    compared(lambda y: pair.solve(apart, y=y).z, in_c_apart)
    failed = False

    if options.growth:
        quick = pair.problem.replace(dx=4e-3, ds=4e-3, regime="none", set={"wheelset.z_mm": 0.2})

        def calls(count):
            for k in range(count):
                pair.solve(quick if k % 4 == 0 else apart, y=1e-6 * (k % 100))

        calls(1000)
        before = memory()
        calls(options.growth)
        grown = memory() - before
        print(f"after {options.growth} calls memory has grown by {grown:.2f} MiB")
        failed = grown > MOST_GROWTH
    return 1 if failed else 0


if __name__ == "__main__":
    np.seterr(all="raise")
    sys.exit(main())
